// The C interface, part 4: meshes in parts. Rows of some points, shares of the functions, the adjoint's sums.
#include "fault_text.hpp"
#include "harmorph/morph/adjoint.hpp"
#include "harmorph/basis/packed_rows.hpp"
#include "open_basis.hpp"

namespace harmorph {
namespace {

Status view_list(Basis const& basis, Index n, const Index* points, PointList& list, Fault& fault) noexcept {
    HARMORPH_TRY(PointList::check_length(n, fault));
    if (n > 0 && points == nullptr) return fault.refuse(Status::bad_argument, "the list of points is NULL");
    list = {basis.header->index_base, {points, static_cast<Size>(n)}};
    return list.check(basis.n_points(), fault);
}

// What goes into parcels, and comes out of them.
Status open_share(const hm_basis* given, Basis& share, Fault& fault) noexcept {
    HARMORPH_TRY(open_solved(given, share, fault));
    return share.require_double(fault);
}

Status extract(Basis const& from, PointList const& list, void* block, Size bytes, hm_basis** out,
               Fault& fault) noexcept {
    Arena arena(block, bytes);
    Extract made;
    made.lay_out(arena, from, list);
    HARMORPH_TRY(arena.verify(bytes, fault));
    made.init(from, list);
    if (from.header->counts.complete()) made.copy_rows(from, list);
    *out = reinterpret_cast<hm_basis*>(made.basis.header);
    return Status::ok;
}

Status check_scale(Index scale, Fault& fault) noexcept {
    if (BinaryScale{scale}.valid()) return Status::ok;
    return fault.refuse(Status::bad_argument, "scale is #, which hm_adjoint_scale never says", Counts::from_zero,
                        scale);
}

// All that calls with a gradient by mesh points have in common.
struct GradientCall {
    Basis basis;
    Points points;
    Executor threads;

    Status open(const hm_basis* given, const hm_points* dj, const void* out, const hm_executor* executor,
                Fault& fault) noexcept {
        if (out == nullptr) return fault.refuse(Status::bad_argument, "an argument is NULL");
        HARMORPH_TRY(open_complete(given, basis, fault));
        if (basis.n_points() > 0) HARMORPH_TRY(view_points(dj, "dj", points, fault));
        return view_executor(executor, threads, fault);
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_extract_size(const hm_basis* basis, int32_t n, size_t* bytes, hm_error* err) {
    Fault fault;
    Basis from;
    if (bytes == nullptr) fault.refuse(Status::bad_argument, "bytes is NULL");
    if (!failed(fault.status) && !failed(PointList::check_length(n, fault)) && !failed(open_solved(basis, from, fault))) {
        Arena counting;
        Extract::count(counting, from, n);
        if (!failed(counting.verify(0, fault))) *bytes = counting.bytes();
    }
    return tell(err, fault);
}

hm_status hm_extract_init(hm_basis** rows, void* block, size_t bytes, const hm_basis* basis, int32_t n,
                          const int32_t* points, hm_error* err) {
    Fault fault;
    Basis from;
    PointList list;
    if (rows == nullptr || block == nullptr) fault.refuse(Status::bad_argument, "rows or block is NULL");
    if (!failed(fault.status) && !failed(open_solved(basis, from, fault)) &&
        !failed(view_list(from, n, points, list, fault))) {
        extract(from, list, block, bytes, rows, fault);
    }
    return tell(err, fault);
}

hm_status hm_parcel_size(const hm_basis* share, int32_t n, int64_t* doubles, hm_error* err) {
    Fault fault;
    Basis from;
    if (doubles == nullptr) fault.refuse(Status::bad_argument, "doubles is NULL");
    if (!failed(fault.status) && !failed(PointList::check_length(n, fault)) && !failed(open_share(share, from, fault))) {
        *doubles = parcel_words(from, n);
    }
    return tell(err, fault);
}

hm_status hm_parcel_pack(const hm_basis* share, int32_t n, const int32_t* points, double* parcel, hm_error* err) {
    Fault fault;
    Basis from;
    PointList list;
    if (parcel == nullptr) fault.refuse(Status::bad_argument, "parcel is NULL");
    if (!failed(fault.status) && !failed(open_share(share, from, fault)) &&
        !failed(view_list(from, n, points, list, fault))) {
        pack_parcel(from, list, parcel);
    }
    return tell(err, fault);
}

hm_status hm_parcel_unpack(hm_basis* rows, const double* parcel, int64_t doubles, hm_error* err) {
    Fault fault;
    Basis to;
    if (parcel == nullptr) fault.refuse(Status::bad_argument, "parcel is NULL");
    if (!failed(fault.status) && !failed(open_basis(rows, to, fault)) && !failed(to.require_double(fault))) {
        unpack_parcel(to, parcel, doubles, fault);
    }
    return tell(err, fault);
}

hm_status hm_adjoint_scale(const hm_basis* basis, const hm_points* dj, int32_t* scale, const hm_executor* executor,
                           hm_error* err) {
    Fault fault;
    GradientCall call;
    if (!failed(call.open(basis, dj, scale, executor, fault))) {
        *scale = adjoint_scale(call.basis, call.points, call.threads).exponent;
    }
    return tell(err, fault);
}

hm_status hm_adjoint_sums(const hm_basis* basis, const hm_points* dj, int32_t scale, int64_t* sums,
                          const hm_executor* executor, hm_error* err) {
    Fault fault;
    GradientCall call;
    if (!failed(call.open(basis, dj, sums, executor, fault)) && !failed(check_scale(scale, fault))) {
        Index const least = adjoint_scale(call.basis, call.points, call.threads).exponent;
        if (scale < least) {
            fault.refuse(Status::bad_argument, "scale is #, these points alone need @", Counts::from_zero, scale,
                         least);
        } else {
            adjoint_sums(call.basis, call.points, {scale}, sums, call.threads);
        }
    }
    return tell(err, fault);
}

hm_status hm_adjoint_finish(const hm_basis* basis, int32_t scale, const int64_t* sums, double* gradient,
                            hm_error* err) {
    Fault fault;
    Basis its;
    if (sums == nullptr || gradient == nullptr) fault.refuse(Status::bad_argument, "sums or gradient is NULL");
    if (!failed(fault.status) && !failed(open_complete(basis, its, fault)) && !failed(check_scale(scale, fault))) {
        adjoint_finish(its, {scale}, sums, gradient);
    }
    return tell(err, fault);
}

}  // extern "C"
