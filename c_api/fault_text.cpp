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
    // Writes whole numbers below 1e15 without an exponent, and all other numbers with six
    // significant digits and an exponent.
    void put_real(Real value) noexcept {
        if (value != value) return put("NaN");
        if (value < 0) put('-');
        Real size = abs(value);
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

// Returns the number that the first item of this kind has for the caller.
Index base_of(ItemKind kind, Bases bases) noexcept {
    Index const known = bases.mesh != none ? bases.mesh : bases.curves;
    switch (kind) {
        case ItemKind::nothing:
        case ItemKind::marker:
        case ItemKind::global_point: return 0;
        case ItemKind::curve:
        case ItemKind::control_point:
        case ItemKind::knot:
            if (bases.curves != none) return bases.curves;
            break;
        default: break;
    }
    return known != none ? known : 0;
}

// An item, numbered from the index base of the caller.
struct NumberedItem {
    ItemKind kind;
    Index base;
    Offset number;

    NumberedItem(Item item, Bases bases) noexcept
        : kind(item.kind), base(base_of(kind, bases)), number(item.number + base) {}

    void tell(int32_t& to_kind, int32_t& to_number, int32_t& to_base) const noexcept {
        if (kind == ItemKind::nothing || number > INT32_MAX)
            return;  // a number that does not fit into int32_t appears in the text only
        to_kind = static_cast<int32_t>(kind);
        to_number = static_cast<int32_t>(number);
        to_base = base;
    }
};

// Writes the number of an item; of a point of a structured block "17 (i=5, j=2)" or "17 (i=5, j=2
// of block 3)". All of them count from the base.
void put_item(NumberedItem const& item, Bases const& bases, Sentence& sentence) noexcept {
    sentence.put_integer(item.number);
    if (item.kind != ItemKind::point || (bases.ni < 1 && bases.n_blocks < 1)) return;
    Offset point = item.number - item.base, ni = bases.ni, block = 0;
    while (block < bases.n_blocks) {
        ni = bases.block_sizes[2 * block];
        Offset const points = ni * bases.block_sizes[2 * block + 1];
        if (point < points) break;
        point -= points;
        ++block;
    }
    if (point < 0 || ni < 1 || (bases.n_blocks > 0 && block == bases.n_blocks)) return;
    sentence.put(" (i=");
    sentence.put_integer(point % ni + item.base);
    sentence.put(", j=");
    sentence.put_integer(point / ni + item.base);
    if (bases.n_blocks > 1) {
        sentence.put(" of block ");
        sentence.put_integer(block + item.base);
    }
    sentence.put(')');
}

void put_sentence(Fault const& fault, NumberedItem const& item, NumberedItem const& other,
                  Bases const& bases, Sentence& sentence) noexcept {
    for (const char* c = fault.sentence; *c != '\0'; ++c) {
        switch (*c) {
            case '#': put_item(item, bases, sentence); break;
            case '@': put_item(other, bases, sentence); break;
            case '~': sentence.put_real(fault.value); break;
            case '$':
                sentence.put('(');
                sentence.put_real(fault.place[0]);
                sentence.put(", ");
                sentence.put_real(fault.place[1]);
                sentence.put(')');
                break;
            case '%': sentence.put(fault.argument); break;
            case '&': sentence.put(fault.other_argument); break;
            default: sentence.put(*c);
        }
    }
}

}  // namespace

hm_status tell(hm_error* err, Fault const& fault, Bases bases) noexcept {
    hm_status const status = static_cast<hm_status>(fault.status);
    if (err == nullptr) return status;
    NumberedItem const item(fault.item, bases), other(fault.other, bases);
    bool const has_first = item.kind != ItemKind::nothing;
    *err = {};
    err->code = status;
    err->item = err->other = -1;
    (has_first ? item : other).tell(err->item_kind, err->item, err->item_base);
    if (has_first) other.tell(err->other_kind, err->other, err->other_base);
    // A refused count or option becomes the value. For a bad basis, the value is the number of
    // missing bytes.
    bool const found = !has_first && fault.value == 0 && fault.status != Status::bad_basis;
    err->value = found ? static_cast<Real>(fault.item.number) : fault.value;
    if (is_finite(fault.place[0]) && is_finite(fault.place[1])) {
        err->x = fault.place[0];
        err->y = fault.place[1];
    }
    Sentence sentence(err->text, sizeof err->text);
    if (fault.sentence != nullptr) put_sentence(fault, item, other, bases, sentence);
    return status;
}

}  // namespace harmorph
