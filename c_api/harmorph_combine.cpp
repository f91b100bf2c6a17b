// The C interface: replaces the functions of control points by functions of design variables.
#include "basis/derived_basis.hpp"
#include "handles.hpp"

namespace harmorph {
namespace {

Status open_source(const hm_basis* handle, Index n, Index numbers, Basis& basis,
                   CallFault& fault) noexcept {
    HARMORPH_TRY(open_complete(handle, basis, fault));
    HARMORPH_TRY(basis.require_double(fault));
    if (numbers != 1 && numbers != 2) {
        return fault.refuse(Status::bad_argument,
                            "numbers must be 1 (real values) or 2 (complex values), not #",
                            plain(numbers));
    }
    Index const shapes = basis.header->counts.shapes();
    if (n >= 1 && n <= shapes) return Status::ok;
    return fault.refuse(n < 1 ? Status::bad_argument : Status::bad_condition,
                        n < 1 ? "n must be at least 1, not #"
                              : "# variables cannot be independent, because the basis has only @ "
                                "functions to combine",
                        plain(n), plain(shapes));
}

Status check_matrix(Basis const& basis, Index n, Index numbers, const double* matrix,
                    Fault& fault) noexcept {
    HARMORPH_TRY(require({{"matrix", matrix}}, fault));
    Offset const length = Offset{basis.header->counts.shapes()} * n * numbers;
    for (Offset k = 0; k < length; ++k) {
        if (is_finite(matrix[k])) continue;
        Index const row = static_cast<Index>(k / (Offset{n} * numbers)),
                    column = static_cast<Index>(k / numbers % n);
        return fault.refuse(Status::bad_argument,
                            "the matrix has a number that is not finite in row # and column @",
                            entry_item(row), variable_item(column));
    }
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_combine(hm_basis** combined, hm_memory* memory, const hm_basis* basis, int32_t n,
                     int32_t numbers, const double* matrix, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Basis from, made;
        HARMORPH_TRY(open_source(basis, n, numbers, from, fault));
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) {
            made.lay_out(arena, combined_counts(from, n, numbers));
        }));
        HARMORPH_TRY(require({{"combined", combined}}, fault));
        HARMORPH_TRY(check_matrix(from, n, numbers, matrix, fault));
        HARMORPH_TRY(combine(from, n, numbers, matrix, made, fault));
        *combined = reinterpret_cast<hm_basis*>(made.header);
        return Status::ok;
    });
}

}  // extern "C"
