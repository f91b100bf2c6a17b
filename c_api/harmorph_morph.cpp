// The C interface: movements of the mesh points, and the transpose.
#include "handles.hpp"
#include "harmorph/morph/adjoint.hpp"
#include "harmorph/morph/morph.hpp"

using namespace harmorph;

extern "C" {

hm_status hm_morph(const hm_basis* basis, const double* move, const hm_points* from, const hm_points_out* to,
                   const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Executor threads;
        Points before;
        MutablePoints after;
        HARMORPH_TRY(open_complete(basis, b, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        HARMORPH_TRY(check_move(b, move, fault));
        HARMORPH_TRY(view_points_if(from, "from", before, fault));
        HARMORPH_TRY(view_points(to, "to", after, fault));
        morph(b, move, before, after, threads);
        return Status::ok;
    });
}

hm_status hm_adjoint(const hm_basis* basis, const hm_points* dj, double* gradient, const hm_executor* executor,
                     hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        Executor threads;
        Points by_points;
        HARMORPH_TRY(require({{"gradient", gradient}}, fault));
        HARMORPH_TRY(open_complete(basis, b, fault));
        HARMORPH_TRY(view_points(dj, "dj", by_points, fault));
        HARMORPH_TRY(view_executor(executor, threads, fault));
        adjoint_morph(b, by_points, gradient, threads);
        return Status::ok;
    });
}

}  // extern "C"
