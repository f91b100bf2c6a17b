// Objects in blocks of exactly their size. A call that is refused says why; a block that is one
// byte too small is refused; nothing is written behind a block.
#pragma once

#include "fixtures/memory.hpp"
#include "block.hpp"
#include "input.hpp"

#include <harmorph.h>

#include <deque>
#include <vector>

namespace fuzz {

// That a refusal has a code, and a text of one line.
inline void expect_told(hm_status status, hm_error const& error) {
    expect(status >= HM_CROSSING && status <= HM_FAR_FROM_POINTS, "a status that does not exist");
    expect(error.code == status, "error.code is not the status");
    std::size_t const length = strnlen(error.text, sizeof error.text);
    expect(length < sizeof error.text, "a text without an end");
    if (status != HM_OK) expect(length > 10, "no text");
}

// That a call has done its work.
inline void expect_done(hm_status status, hm_error const& error, std::string const& what) {
    expect_told(status, error);
    expect(status >= 0, what + " is refused: " + error.text);
}

// That a refused call has left the arrays that were filled with 7.
template <class Number>
void expect_untouched(std::vector<Number> const& numbers) {
    for (Number const number : numbers) expect(number == 7, "a refused call has written");
}

// A struct that begins with its size.
template <class Struct>
Struct sized() {
    Struct out{};
    out.struct_size = sizeof out;
    return out;
}

inline hm_basis_info info_of(const hm_basis* basis) {
    hm_basis_info info = sized<hm_basis_info>();
    expect(hm_basis_info_get(basis, &info, nullptr) == HM_OK, "no information about a basis");
    return info;
}

using fixtures::init_by;
using fixtures::size_by;

class Blocks {
public:
    // `aligned`: half of the blocks end at the end of a page, whatever their size.
    explicit Blocks(Input& input, bool aligned = false) : input_(input), aligned_(aligned) {}

    // A block of arbitrary bytes.
    Block& take(std::size_t bytes) {
        int const fill = input_.any_of({0, 0xFF, 0x7F, 0xA5});
        std::size_t const shift = !aligned_ || input_.one_in(2) ? input_.below(64) : 0;
        all_.emplace_back(bytes, shift, fill);
        return all_.back();
    }
    // The size, one byte less, exactly that.
    template <class Size, class Init>
    hm_status make(hm_error& error, Size const& size, Init const& init) {
        std::size_t bytes = 0;
        hm_status status = size(&bytes, &error);
        expect_told(status, error);
        if (status < 0) return status;
        expect(bytes > 0, "an object without a size");
        if (bytes > std::size_t{1} << 28) return HM_BAD_ARGUMENT;  // of counts that were made wrong
        Block& made = take(bytes);
        hm_status const less = init(made.data(), bytes - 1, &error);
        expect_told(less, error);
        expect(less < 0, "a block that is one byte too small is taken");
        bool const was_too_small = less == HM_BLOCK_TOO_SMALL;
        status = init(made.data(), bytes, &error);
        expect_told(status, error);
        made.expect_intact();
        if (status >= 0) expect(was_too_small, "one byte less: another reason");
        expect(status != HM_BLOCK_TOO_SMALL, "a block of the stated size is too small");
        return status;
    }
    void expect_intact() const {
        for (Block const& block : all_) block.expect_intact();
    }

private:
    Input& input_;
    bool aligned_;
    std::deque<Block> all_;
};

}  // namespace fuzz
