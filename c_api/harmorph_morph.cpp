// The C interface: moves the mesh points, and computes the transpose.
#include "apart.hpp"
#include "handles.hpp"
#include "morph/adjoint.hpp"
#include "morph/morph.hpp"

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
        HARMORPH_TRY(Apart::check_in_place("from", before, "to", after, b.n_points(), fault));
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
        Apart arrays;
        arrays.add("dj", by_points, b.n_points());
        HARMORPH_TRY(
            arrays.check("gradient", gradient, 2 * Offset{b.header->counts.functions()}, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        adjoint_morph(b, by_points, gradient, threads);
        return Status::ok;
    });
}

}  // extern "C"
