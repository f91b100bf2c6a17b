// Reads a struct of the caller, and compares its numbers with a table of what they may be.
#pragma once

#include "views.hpp"

namespace harmorph {

// The refusals are not in the templates, so that the library has each of them once.
Status refuse_integer(Status why, const char* sentence, Index number, Item element,
                      Fault& fault) noexcept;
Status refuse_size(const char* name, const char* type, Fault& fault) noexcept;
Status refuse_unknown_fields(const char* name, Fault& fault) noexcept;
Status refuse_size_of_element(Item item, const char* what, const char* type, Fault& fault) noexcept;
Status refuse_unknown_fields_of_element(Item item, const char* what, Fault& fault) noexcept;

// What one number of a struct may be, and the sentence if it is not. In the sentence, # stands for
// an integer and ~ for a real number. In sentences about an element of an array, # is the element,
// and an integer is @.
template <class Struct>
struct Limit {
    enum class Zero { in_range, is_default };  // is_default: 0 is allowed, too, outside the range

    std::int32_t Struct::*integer = nullptr;
    double Struct::*real = nullptr;
    Real low, high;
    const char* sentence;
    Status status = Status::bad_argument;
    Zero zero = Zero::in_range;

    constexpr Limit(std::int32_t Struct::*member, Real smallest, Real largest, const char* text,
                    Status refused = Status::bad_argument) noexcept
        : integer(member), low(smallest), high(largest), sentence(text), status(refused) {}
    constexpr Limit(double Struct::*member, Real smallest, Real largest, const char* text,
                    Zero of_zero = Zero::in_range) noexcept
        : real(member), low(smallest), high(largest), sentence(text), zero(of_zero) {}

    bool allows(Struct const& given) const noexcept {
        Real const number = real != nullptr ? given.*real : Real(given.*integer);
        if (number != number) return false;  // NaN; < would raise a floating-point exception
        return (low <= number && number <= high) || (zero == Zero::is_default && number == 0);
    }
    Status refuse(Struct const& given, Item element, Fault& fault) const noexcept {
        if (real != nullptr) return fault.refuse(status, sentence, element, {}, given.*real);
        return refuse_integer(status, sentence, given.*integer, element, fault);
    }
};

// Refuses the first number that is not within its limits. `element` is the struct, if it is one of
// several.
template <class Struct, Size n>
Status check_limits(Struct const& given, const Limit<Struct> (&limits)[n], Fault& fault,
                    Item element = {}) noexcept {
    for (Limit<Struct> const& limit : limits) {
        if (!limit.allows(given)) return limit.refuse(given, element, fault);
    }
    return Status::ok;
}

// Reads a struct that must not be NULL. `name` is the name of the argument or field, `type` that of
// the struct in the header. A newer header may have more fields, which must not be set: they would
// be ignored silently.
template <class Struct>
Status open_struct(const Struct* given, Struct& out, const char* name, const char* type,
                   Fault& fault) noexcept {
    if (given == nullptr) return fault.refuse_argument(name, "% is NULL");
    if (!read_struct(given, out)) return refuse_size(name, type, fault);
    return asks_for_more(given) ? refuse_unknown_fields(name, fault) : Status::ok;
}

// Reads options, which are defaults if `given` is NULL.
template <class Struct>
Status open_options(const Struct* given, Struct& out, const char* name, const char* type,
                    Fault& fault) noexcept {
    out = Struct{};
    return given == nullptr ? Status::ok : open_struct(given, out, name, type, fault);
}

// Reads an element of an array of structs. `what` is what the sentence calls the element.
template <class Struct>
Status open_element(const Struct* array, Index number, Struct& out, Item item, const char* what,
                    const char* type, Fault& fault) noexcept {
    if (!read_struct(array, out) || !read_struct(element(array, number), out))
        return refuse_size_of_element(item, what, type, fault);
    return asks_for_more(element(array, number))
               ? refuse_unknown_fields_of_element(item, what, fault)
               : Status::ok;
}

}  // namespace harmorph
