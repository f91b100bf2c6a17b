// The C interface: gives right-hand sides and residuals of the functions at the points of a part,
// and takes their values.
#include "base/vec2.hpp"
#include "operators/right_hand_sides.hpp"
#include "part_handles.hpp"

namespace harmorph {
namespace {

// Equations, and rows that were made from them.
struct RowsCall {
    const PartEquations* equations = nullptr;
    Basis basis;

    Status open_both(const hm_private_equations* handle, const hm_basis* rows,
                     CallFault& fault) noexcept {
        HARMORPH_TRY(open(handle, "equations", equations, fault));
        HARMORPH_TRY(open_basis(rows, basis, fault));
        if (!equations->matches(basis))
            return fault.refuse(Status::bad_basis, "the rows were made from other equations");
        if (basis.header->solved == 0) return Status::ok;
        return fault.refuse(Status::bad_basis,
                            "the rows are finished; make new ones by hm_private_rows_init");
    }
    Status check_column(Index column, Argument const& numbers, Fault& fault) const noexcept {
        HARMORPH_TRY(require({numbers}, fault));
        if (column >= 0 && column < equations->columns(basis)) return Status::ok;
        return fault.refuse(Status::bad_argument, "column # does not exist; there are @ columns",
                            entry_item(column), plain(equations->columns(basis)));
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_private_rows_size(const hm_private_equations* equations, size_t* bytes,
                               hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const PartEquations* opened = nullptr;
        HARMORPH_TRY(open(equations, "equations", opened, fault));
        Basis made;
        return count_bytes(bytes, fault, [&](Arena& arena) {
            made.lay_out(arena, opened->basis_source().counts());
        });
    });
}

hm_status hm_private_rows_init(hm_basis** rows, void* block, size_t bytes,
                               const hm_private_equations* equations, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const PartEquations* opened = nullptr;
        HARMORPH_TRY(require({{"rows", rows}}, fault));
        HARMORPH_TRY(open(equations, "equations", opened, fault));
        BasisCounts const counts = opened->basis_source().counts();
        Basis made;
        HARMORPH_TRY(
            place(block, bytes, fault, [&](Arena& arena) { made.lay_out(arena, counts); }));
        init_basis(made, counts, opened->basis_source());
        made.header->coordinates =
            opened->coordinates;  // distinguishes rows from other bases that are not solved
        set_right_hand_sides(opened->matrix, made, opened->dofs(made));
        *rows = reinterpret_cast<hm_basis*>(made.header);
        return Status::ok;
    });
}

hm_status hm_private_rows_get(const hm_private_equations* equations, const hm_basis* rows,
                              int32_t column, double* numbers, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RowsCall call;
        HARMORPH_TRY(call.open_both(equations, rows, fault));
        HARMORPH_TRY(call.check_column(column, {"numbers", numbers}, fault));
        call.equations->get(call.equations->dofs(call.basis), column, numbers);
        return Status::ok;
    });
}

hm_status hm_private_rows_set(const hm_private_equations* equations, hm_basis* rows, int32_t column,
                              const double* numbers, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RowsCall call;
        HARMORPH_TRY(call.open_both(equations, rows, fault));
        HARMORPH_TRY(call.check_column(column, {"numbers", numbers}, fault));
        call.equations->set(call.equations->dofs(call.basis), column, numbers);
        return Status::ok;
    });
}

hm_status hm_private_rows_residual(hm_private_equations* equations, const hm_basis* rows,
                                   int32_t column, double* residual, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RowsCall call;
        HARMORPH_TRY(call.open_both(equations, rows, fault));
        HARMORPH_TRY(call.check_column(column, {"residual", residual}, fault));
        call.equations->find_residual(call.equations->dofs(call.basis), column, residual);
        return Status::ok;
    });
}

hm_status hm_private_rows_finish(hm_private_equations* equations, hm_basis* rows, double largest,
                                 hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        RowsCall call;
        HARMORPH_TRY(call.open_both(equations, rows, fault));
        if (!is_finite(largest) || largest < 0) {
            return fault.refuse(Status::bad_argument,
                                "largest must be finite and at least 0, not ~", {}, {}, largest);
        }
        call.equations->finish(call.basis, largest);
        return Status::ok;
    });
}

}  // extern "C"
