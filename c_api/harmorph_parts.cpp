// The C interface for several processes: bases of some points, shares of the functions, parcels,
// the sums of the adjoint.
#include "basis/point_subset.hpp"
#include "handles.hpp"
#include "morph/adjoint.hpp"

namespace harmorph {
namespace {

Status view_list(Basis const& basis, Index n, const Index* points, PointList& list,
                 Fault& fault) noexcept {
    HARMORPH_TRY(PointList::check_length(n, fault));
    if (n > 0 && points == nullptr)
        return fault.refuse(Status::bad_argument, "points is NULL, but n is #", plain(n));
    list = {basis.header->index_base, {points, static_cast<Size>(n)}};
    return list.check(basis.n_points(), fault);
}

Status count_share(Analysis const& analysis, Index first, Index n, BasisCounts& counts,
                   Fault& fault) noexcept {
    BasisCounts const all = analysis.basis_counts();
    if (first < 0 || n < 0 || n > all.functions() - first) {
        return fault.refuse(
            Status::bad_argument,
            "first is # and n is @, but functions first to first + n - 1 must exist",
            function_item(first), plain(n));
    }
    counts = all.share(first, n);
    return Status::ok;
}

Status check_scale(Index scale, Fault& fault) noexcept {
    if (BinaryScale{scale}.valid()) return Status::ok;
    return fault.refuse(
        Status::bad_argument,
        "scale is #, but it must be a number that hm_private_adjoint_scale returned", plain(scale));
}

// The arguments that the calls with derivatives by mesh points have in common.
struct GradientCall {
    Basis basis;
    Points points;
    Executor threads;

    Status open(const hm_basis* handle, const hm_points* dj, const hm_executor* executor,
                CallFault& fault) noexcept {
        HARMORPH_TRY(open_complete(handle, basis, fault));
        Index const n = basis.n_points();
        if (n > 0) HARMORPH_TRY(view_points(dj, "dj", points, fault, n));
        return view_executor(executor, threads, fault);
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_private_extract_size(const hm_basis* basis, int32_t n, size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis from;
        HARMORPH_TRY(PointList::check_length(n, fault));
        HARMORPH_TRY(open_basis(basis, from, fault));
        return count_bytes(bytes, fault, [&](Arena& arena) { Extract::count(arena, from, n); });
    });
}

hm_status hm_private_extract_init(hm_basis** rows, void* block, size_t bytes, const hm_basis* basis,
                                  int32_t n, const int32_t* points, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis from;
        PointList list;
        HARMORPH_TRY(require({{"rows", rows}}, fault));
        HARMORPH_TRY(open_solved(basis, from, fault));
        HARMORPH_TRY(view_list(from, n, points, list, fault));
        Extract made;
        HARMORPH_TRY(
            place(block, bytes, fault, [&](Arena& arena) { made.lay_out(arena, from, list); }));
        made.init(from, list);
        if (from.header->counts.complete()) made.copy_rows(from, list);
        *rows = reinterpret_cast<hm_basis*>(made.basis.header);
        return Status::ok;
    });
}

hm_status hm_private_share_of(const hm_analysis* analysis, int32_t part, int32_t n_parts,
                              int32_t* first, int32_t* n, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        HARMORPH_TRY(require({{"first", first}, {"n", n}}, fault));
        if (part < 0 || part >= n_parts) {
            return fault.refuse(
                Status::bad_argument,
                "part is #, but it must be at least 0 and below n_parts, which is @",
                entry_item(part), plain(n_parts));
        }
        HARMORPH_TRY(open_complete(analysis, opened, fault));
        Offset const functions = opened->basis_counts().functions();
        *first = static_cast<Index>(functions * part / n_parts);
        *n = static_cast<Index>(functions * (part + Offset{1}) / n_parts) - *first;
        return Status::ok;
    });
}

hm_status hm_private_share_size(const hm_analysis* analysis, int32_t first, int32_t n,
                                size_t* bytes, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        BasisCounts counts;
        HARMORPH_TRY(open_complete(analysis, opened, fault));
        HARMORPH_TRY(count_share(*opened, first, n, counts, fault));
        Basis made;
        return count_bytes(bytes, fault, [&](Arena& arena) { made.lay_out(arena, counts); });
    });
}

hm_status hm_private_share_init(hm_basis** share, void* block, size_t bytes,
                                const hm_analysis* analysis, int32_t first, int32_t n,
                                hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        BasisCounts counts;
        HARMORPH_TRY(require({{"share", share}}, fault));
        HARMORPH_TRY(open_complete(analysis, opened, fault));
        HARMORPH_TRY(count_share(*opened, first, n, counts, fault));
        hm_memory memory = {block, bytes};
        return make_basis(*opened, counts, &memory, share, fault);
    });
}

hm_status hm_private_parcel_size(const hm_basis* share, int32_t n, int64_t* doubles,
                                 hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis from;
        HARMORPH_TRY(require({{"doubles", doubles}}, fault));
        HARMORPH_TRY(PointList::check_length(n, fault));
        HARMORPH_TRY(open_solved(share, from, fault));
        HARMORPH_TRY(from.require_double(fault));
        *doubles = parcel_words(from, n);
        return Status::ok;
    });
}

hm_status hm_private_parcel_pack(const hm_basis* share, int32_t n, const int32_t* points,
                                 double* parcel, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis from;
        PointList list;
        HARMORPH_TRY(require({{"parcel", parcel}}, fault));
        HARMORPH_TRY(open_solved(share, from, fault));
        HARMORPH_TRY(from.require_double(fault));
        HARMORPH_TRY(view_list(from, n, points, list, fault));
        pack_parcel(from, list, parcel);
        return Status::ok;
    });
}

hm_status hm_private_parcel_unpack(hm_basis* rows, const double* parcel, int64_t doubles,
                                   hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis to;
        HARMORPH_TRY(require({{"parcel", parcel}}, fault));
        HARMORPH_TRY(open_basis(rows, to, fault));
        HARMORPH_TRY(to.require_double(fault));
        return unpack_parcel(to, parcel, doubles, fault);
    });
}

hm_status hm_private_adjoint_scale(const hm_basis* basis, const hm_points* dj, int32_t* scale,
                                   const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        GradientCall call;
        HARMORPH_TRY(require({{"scale", scale}}, fault));
        HARMORPH_TRY(call.open(basis, dj, executor, fault));
        *scale = adjoint_scale(call.basis, call.points, call.threads).exponent;
        return Status::ok;
    });
}

hm_status hm_private_adjoint_sums(const hm_basis* basis, const hm_points* dj, int32_t scale,
                                  int64_t* sums, const hm_executor* executor, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        GradientCall call;
        HARMORPH_TRY(require({{"sums", sums}}, fault));
        HARMORPH_TRY(call.open(basis, dj, executor, fault));
        HARMORPH_TRY(check_scale(scale, fault));
        Index const min_scale = adjoint_scale(call.basis, call.points, call.threads).exponent;
        if (scale < min_scale) {
            return fault.refuse(
                Status::bad_argument,
                "scale is #, but these points need at least @; take the largest scale of all parts",
                plain(scale), plain(min_scale));
        }
        adjoint_sums(call.basis, call.points, {scale}, sums, call.threads);
        return Status::ok;
    });
}

hm_status hm_private_adjoint_finish(const hm_basis* basis, int32_t scale, const int64_t* sums,
                                    double* gradient, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        HARMORPH_TRY(require({{"sums", sums}, {"gradient", gradient}}, fault));
        HARMORPH_TRY(open_complete(basis, b, fault));
        HARMORPH_TRY(check_scale(scale, fault));
        adjoint_finish(b, {scale}, sums, gradient);
        return Status::ok;
    });
}

}  // extern "C"
