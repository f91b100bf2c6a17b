// The C interface: moves the mesh points, and computes the transpose.
#include "handles.hpp"
#include "morph/adjoint.hpp"
#include "morph/morph.hpp"

namespace harmorph {
namespace {

// Tells whether two arrays of the same stride overlap such that point k of one is another point of
// the other.
bool are_shifted(const double* a, const double* b, std::ptrdiff_t stride, Index n) noexcept {
    std::uintptr_t const bytes =
        a < b ? reinterpret_cast<std::uintptr_t>(b) - reinterpret_cast<std::uintptr_t>(a)
              : reinterpret_cast<std::uintptr_t>(a) - reinterpret_cast<std::uintptr_t>(b);
    std::uintptr_t const step = static_cast<std::uintptr_t>(stride) * sizeof(double);
    return bytes != 0 && bytes % step == 0 && bytes / step < static_cast<std::uintptr_t>(n);
}

Status check_apart(Points from, MutablePoints to, Index n, Fault& fault) noexcept {
    if (from.x == nullptr || from.stride != to.stride) return Status::ok;
    bool const apart =
        !are_shifted(from.x, to.x, to.stride, n) && !are_shifted(from.y, to.y, to.stride, n);
    if (apart && from.x != to.y && from.y != to.x) return Status::ok;
    return fault.refuse_argument("to",
                                 "% has numbers in common with `from`, but at other points; give "
                                 "the same arrays or separate ones");
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_morph(const hm_basis* basis, const double* move, const hm_points* from,
                   const hm_points_out* to, const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Executor threads;
        Points before;
        MutablePoints after;
        HARMORPH_TRY(open_complete(basis, b, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(check_move(b, move, fault));
        HARMORPH_TRY(view_points_if(from, "from", before, fault, b.n_points()));
        HARMORPH_TRY(view_points(to, "to", after, fault, b.n_points()));
        HARMORPH_TRY(check_apart(before, after, b.n_points(), fault));
        morph(b, move, before, after, threads);
        return Status::ok;
    });
}

hm_status hm_adjoint(const hm_basis* basis, const hm_points* dj, double* gradient,
                     const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Executor threads;
        Points by_points;
        HARMORPH_TRY(require({{"gradient", gradient}}, fault));
        HARMORPH_TRY(open_complete(basis, b, fault));
        HARMORPH_TRY(view_points(dj, "dj", by_points, fault, b.n_points()));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        adjoint_morph(b, by_points, gradient, threads);
        return Status::ok;
    });
}

}  // extern "C"
