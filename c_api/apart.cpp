#include "apart.hpp"

namespace harmorph {
namespace {

std::uintptr_t greatest_divisor(std::uintptr_t a, std::uintptr_t b) noexcept {
    while (b != 0) {
        std::uintptr_t const rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

}  // namespace

void Apart::add(const char* name, const double* array, Offset n, Offset stride) noexcept {
    if (array == nullptr || n <= 0 || count_ == max_arrays) return;
    std::uintptr_t const begin = reinterpret_cast<std::uintptr_t>(array),
                         step = static_cast<std::uintptr_t>(stride) * sizeof(double);
    arrays_[count_++] = {name, begin,
                         begin + static_cast<std::uintptr_t>(n - 1) * step + sizeof(double), step};
}

// Numbers of both arrays lie at equal addresses modulo the greatest divisor of both steps, or none
// do: x and y of pairs, for example, share their range but no number. With different steps the
// condition is necessary, not sufficient.
bool Apart::have_common(Array const& a, Array const& b) noexcept {
    if (a.begin >= b.end || b.begin >= a.end) return false;
    std::uintptr_t const between = a.begin < b.begin ? b.begin - a.begin : a.begin - b.begin,
                         within = between % greatest_divisor(a.step, b.step);
    return within < sizeof(double) || greatest_divisor(a.step, b.step) - within < sizeof(double);
}

Status Apart::check(const char* name, const double* array, Offset n, Fault& fault,
                    Offset stride) noexcept {
    Index const before = count_;
    add(name, array, n, stride);
    if (count_ == before) return Status::ok;
    for (Index k = 0; k < before; ++k) {
        if (!have_common(arrays_[k], arrays_[before])) continue;
        if (arrays_[k].name == name)
            return fault.refuse_argument(
                name, "two arrays of % have numbers in common; give separate arrays");
        return fault.refuse_arguments(name, arrays_[k].name,
                                      "% and & have numbers in common; give separate arrays");
    }
    return Status::ok;
}

Status Apart::check_in_place(const char* from_name, Points from, const char* to_name,
                             MutablePoints to, Index n, Fault& fault) noexcept {
    Apart written, arrays;
    HARMORPH_TRY(written.check(to_name, to, n, fault));
    bool const same = from.x == to.x && from.y == to.y && from.stride == to.stride;
    if (same || from.x == nullptr) return Status::ok;
    arrays.add(from_name, from, n);
    if (!failed(arrays.check(to_name, to, n, fault))) return Status::ok;
    return fault.refuse_arguments(to_name, from_name,
                                  "% and & have numbers in common, but at other points; give the "
                                  "same arrays or separate ones");
}

}  // namespace harmorph
