#include "fault_text.hpp"

#include "base/scalar.hpp"

namespace harmorph {
namespace {

class Sentence {
public:
    Sentence(char* text, Size capacity) noexcept : text_(text), room_(capacity - 1) {
        text_[0] = '\0';
    }

    void put(char c) noexcept {
        if (room_ == 0) return;
        --room_;
        *text_++ = c;
        *text_ = '\0';
    }
    void put(const char* word) noexcept {
        while (*word != '\0') put(*word++);
    }
    void put_integer(Offset value) noexcept {
        char digits[24];
        Index n = 0;
        Offset rest = value < 0 ? -value : value;
        do digits[n++] = static_cast<char>('0' + rest % 10);
        while ((rest /= 10) != 0);
        if (value < 0) put('-');
        while (n > 0) put(digits[--n]);
    }
    // Six significant digits; plain for whole numbers below 1e15, otherwise with an exponent.
    void put_real(Real value) noexcept {
        if (value != value) return put("NaN");
        if (value < 0) put('-');
        Real size = absolute(value);
        if (!is_finite(size)) return put("infinity");
        if (size < 1e15 && size == static_cast<Real>(static_cast<Offset>(size))) {
            return put_integer(static_cast<Offset>(size));
        }
        Index exponent = 0;
        for (; size >= 10; ++exponent) size /= 10;
        for (; size < 1; --exponent) size *= 10;
        Offset digits = static_cast<Offset>(size * 1e5 + 0.5);
        if (digits >= 1000000) {
            digits /= 10;
            ++exponent;
        }
        put_integer(digits / 100000);
        put('.');
        for (Offset unit = 10000; unit > 0; unit /= 10)
            put(static_cast<char>('0' + digits / unit % 10));
        if (exponent == 0) return;
        put('e');
        put_integer(exponent);
    }

private:
    char* text_;
    Size room_;
};

}  // namespace

hm_status tell(hm_error* err, Fault const& fault, Bases bases) noexcept {
    hm_status const status = static_cast<hm_status>(fault.status);
    if (err == nullptr) return status;
    bool const of_mesh = fault.counts == Counts::mesh || fault.counts == Counts::mesh_and_marker;
    Index const base = of_mesh ? bases.mesh : fault.counts == Counts::curves ? bases.curves : 0;
    bool const both = fault.counts == Counts::mesh;  // count from the base
    auto const numbered = [&](Index item) { return Offset{item} + base; };
    err->code = status;
    err->item = fault.item == none ? none : static_cast<Index>(numbered(fault.item));
    err->value = fault.value;
    Sentence sentence(err->text, sizeof err->text);
    for (const char* c = fault.sentence; *c != '\0'; ++c) {
        switch (*c) {
            case '#': sentence.put_integer(numbered(fault.item)); break;
            case '@': sentence.put_integer(both ? numbered(fault.other) : fault.other); break;
            case '~': sentence.put_real(fault.value); break;
            case '$':
                sentence.put('(');
                sentence.put_real(fault.place[0]);
                sentence.put(", ");
                sentence.put_real(fault.place[1]);
                sentence.put(')');
                break;
            case '%': sentence.put(fault.argument); break;
            default: sentence.put(*c);
        }
    }
    return status;
}

}  // namespace harmorph
