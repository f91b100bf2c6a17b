// The C interface: reads the contents of a basis. These calls need no plan.
#include "apart.hpp"
#include "handles.hpp"

namespace harmorph {
namespace {

hm_basis_info info_of(Basis const& basis) noexcept {
    BasisHeader const& header = *basis.header;
    hm_basis_info filled = {};
    filled.bytes = header.bytes;
    filled.solved = header.solved;
    filled.points = header.counts.points;
    filled.cells = header.counts.cells;
    filled.functions = header.counts.functions();
    filled.curves = header.counts.curves;
    filled.curve_points = header.counts.wall;
    filled.numbers_per_value = numbers_of(header.counts.kind);
    filled.operator_kind = static_cast<std::int32_t>(header.method.operator_kind);
    filled.scheme = static_cast<std::int32_t>(header.method.scheme);
    filled.engine = static_cast<std::int32_t>(header.method.engine);
    filled.exponent = header.method.exponent_quarters / 4.0;
    filled.bodies = header.counts.bodies;
    filled.offset_correction = header.method.offset_correction;
    filled.storage = static_cast<std::int32_t>(header.counts.storage);
    filled.combined = header.counts.combined;
    filled.control_points = header.counts.control;
    filled.modes = header.counts.modes;
    filled.index_base = header.index_base;
    filled.curve_point = basis.wall_point.data();
    filled.point_curve = basis.wall_curve.data();
    filled.point_u = basis.wall_u.data();
    filled.shared_points = header.counts.shared;
    filled.shared_point = basis.shared_point.data();
    filled.shared_condition = basis.shared_condition.data();
    return filled;
}

// Opens the basis and checks that there is room for all of its curves.
Status open_curves(const hm_basis* handle, hm_curves* out, const hm_curve* curve, Index capacity,
                   Basis& basis, CallFault& fault) noexcept {
    HARMORPH_TRY(require({{"curve", curve}}, fault));
    HARMORPH_TRY(check_report(out, "out", fault));
    HARMORPH_TRY(open_basis(handle, basis, fault));
    Index const n = basis.header->counts.curves;
    if (capacity >= n) return Status::ok;
    return fault.refuse(Status::bad_argument, "curve has room for # curves, but the basis has @",
                        plain(capacity), plain(n));
}

hm_curves curves_of(Basis const& basis, const double* control, hm_curve* curve) noexcept {
    Index const n = basis.header->counts.curves;
    for (Index i = 0; i < n; ++i) curve[i] = struct_of(basis.curve(i));
    return {sizeof(hm_curves),
            0,
            basis.header->counts.control,
            control,
            basis.weights.empty() ? nullptr : basis.weights.data(),
            n,
            curve};
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_basis_info_get(const hm_basis* basis, hm_basis_info* info, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        HARMORPH_TRY(check_report(info, "info", fault));
        HARMORPH_TRY(open_basis(basis, b, fault));
        write_struct(info_of(b), info);
        return Status::ok;
    });
}

hm_status hm_basis_curves(const hm_basis* basis, const double* move, double* control,
                          hm_curves* out, hm_curve* curve, int32_t capacity, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        if (move != nullptr) HARMORPH_TRY(require({{"control", control}}, fault));
        HARMORPH_TRY(open_curves(basis, out, curve, capacity, b, fault));
        if (move == nullptr) {
            write_struct(curves_of(b, b.control.data(), curve), out);
            return Status::ok;
        }
        HARMORPH_TRY(check_move(b, move, fault));
        Apart arrays;
        arrays.add("move", move, 2 * b.header->counts.functions());
        HARMORPH_TRY(arrays.check("control", control, 2 * b.header->counts.control, fault));
        for (Index i = 0; i < b.header->counts.control; ++i) {
            Vec2 const by = b.control_move(i, move);
            control[2 * i] = b.control[2 * i] + by.x;
            control[2 * i + 1] = b.control[2 * i + 1] + by.y;
        }
        write_struct(curves_of(b, control, curve), out);
        return Status::ok;
    });
}

hm_status hm_basis_conditions(const hm_basis* basis, hm_condition* out, int32_t capacity,
                              int32_t* n, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        HARMORPH_TRY(require({{"n", n}}, fault));
        if (capacity < 0) {
            return fault.refuse(Status::bad_argument, "capacity must be at least 0, not #",
                                plain(capacity));
        }
        if (capacity > 0) HARMORPH_TRY(check_report(out, "out", fault));
        HARMORPH_TRY(open_basis(basis, b, fault));
        *n = b.conditions.count();
        if (*n > capacity) {
            return fault.refuse(Status::bad_argument,
                                "out has room for # conditions, but the basis has @",
                                plain(capacity), plain(*n));
        }
        for (Index i = 0; i < *n; ++i) write_element(struct_of(b.conditions[i]), out, i);
        return Status::ok;
    });
}

hm_status hm_basis_along(const hm_basis* basis, int32_t condition, hm_curves* out, hm_curve* curve,
                         int32_t capacity, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        HARMORPH_TRY(require({{"curve", curve}}, fault));
        HARMORPH_TRY(check_report(out, "out", fault));
        HARMORPH_TRY(open_basis(basis, b, fault));
        Index const count = b.conditions.count();
        if (condition < 0 || condition >= count) {
            return fault.refuse(Status::bad_argument, "condition # does not exist; the basis has @",
                                condition_item(condition), plain(count));
        }
        Condition const& kept = b.conditions[condition];
        if (kept.kind != ConditionKind::slip || kept.n_curves == 0) {
            return fault.refuse(Status::bad_argument,
                                "condition # of the basis has no curves along which points slip",
                                condition_item(condition));
        }
        if (capacity < kept.n_curves) {
            return fault.refuse(Status::bad_argument,
                                "curve has room for # curves, but the condition has @",
                                plain(capacity), plain(kept.n_curves));
        }
        for (Index k = 0; k < kept.n_curves; ++k)
            curve[k] = struct_of(b.along.curve(kept.first_curve + k));
        Curve const any = b.along.curve(kept.first_curve);
        hm_curves filled = {};
        filled.n_control = any.n_control;
        filled.control = any.control;
        filled.weights = any.weights;
        filled.n_curves = kept.n_curves;
        filled.curve = curve;
        write_struct(filled, out);
        return Status::ok;
    });
}

hm_status hm_basis_values(const hm_basis* basis, int32_t function, int32_t number, double* values,
                          hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        HARMORPH_TRY(require({{"values", values}}, fault));
        HARMORPH_TRY(open_solved(basis, b, fault));
        Index const first = b.header->counts.first_stored;
        if (function < first || function - first >= b.n_functions()) {
            return fault.refuse(Status::bad_argument, "function # does not exist; the basis has @",
                                function_item(function), plain(b.n_functions()));
        }
        if (number < 0 || number >= numbers_of(b.kind())) {
            return fault.refuse(Status::bad_argument,
                                "number # does not exist; numbers_per_value of this basis is @",
                                entry_item(number), plain(numbers_of(b.kind())));
        }
        b.column(number * b.n_functions() + function - first, values);
        return Status::ok;
    });
}

hm_status hm_basis_matrix(const hm_basis* basis, double* matrix, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis b;
        HARMORPH_TRY(require({{"matrix", matrix}}, fault));
        HARMORPH_TRY(open_complete(basis, b, fault));
        Index const functions = b.n_functions();
        Offset const plane = Offset{b.n_points()} * functions;
        for (Index number = 0; number < numbers_of(b.kind()); ++number)
            for (Index i = 0; i < functions; ++i)
                b.column(number * functions + i, matrix + number * plane + i, functions);
        return Status::ok;
    });
}

}  // extern "C"
