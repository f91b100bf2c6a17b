// Counting and placing agree; what is placed is aligned, apart, and inside.
#include <doctest/doctest.h>

#include <fixtures/guarded.hpp>

#include "base/arena.hpp"

#include <limits>
#include <random>

using namespace harmorph;
using fixtures::Guarded;

namespace {

struct Layout {
    Span<double> a;
    Span<char> b;
    Span<Index> c, overlaid, d;
    std::size_t sizes[5];

    void lay_out(Arena& arena) {
        arena.take(a, sizes[0]);
        arena.take(b, sizes[1]);
        auto const mark = arena.mark();
        arena.take(c, sizes[2]);
        arena.release(mark);
        arena.take(overlaid, sizes[3]);  // where c was
        arena.take(d, sizes[4]);
    }
};

}  // namespace

TEST_CASE("an arena of the counted size holds aligned arrays at any address without overlap") {
    std::mt19937 random(1);
    for (int trial = 0; trial < 300; ++trial) {
        Layout layout;
        for (std::size_t& size : layout.sizes)
            size = random() % 3 == 0 ? random() % 3 : random() % 500;
        Arena counting;
        layout.lay_out(counting);
        CHECK(!counting.placing());
        // Nothing to use yet.
        CHECK(layout.a.empty());
        CHECK(layout.d.empty());
        Guarded block(counting.bytes(), random() % 64);
        Arena placing(block.data(), block.size());
        layout.lay_out(placing);
        CHECK(!placing.overflown());
        CHECK(placing.bytes() == counting.bytes());
        unsigned char const* end = block.data();
        auto const check = [&](auto span, std::size_t size) {
            REQUIRE(span.size() == size);
            unsigned char const* const begin = reinterpret_cast<unsigned char const*>(span.data());
            CHECK(reinterpret_cast<std::uintptr_t>(begin) % Arena::alignment == 0);
            CHECK(begin >= end);
            unsigned char const* const span_end = begin + size * sizeof(*span.data());
            CHECK(span_end <= block.data() + block.size());
            std::memset(span.data(), 1, size * sizeof(*span.data()));
            return span_end;
        };
        end = check(layout.a, layout.sizes[0]);
        end = check(layout.b, layout.sizes[1]);
        check(layout.c, layout.sizes[2]);
        end = check(layout.overlaid, layout.sizes[3]);
        check(layout.d, layout.sizes[4]);
        CHECK(layout.c.data() == layout.overlaid.data());
        CHECK(block.guards_intact());
    }
}

TEST_CASE("an arena that is one byte too small is noticed, and the missing size is reported") {
    Layout layout;
    for (std::size_t& size : layout.sizes) size = 100;
    Arena counting;
    layout.lay_out(counting);
    for (std::size_t const missing : {std::size_t{1}, std::size_t{70}, std::size_t{800},
                                      counting.bytes() - 1, counting.bytes()}) {
        Guarded block(counting.bytes() - missing);
        Arena placing(block.data(), block.size());
        layout.lay_out(placing);
        CHECK(placing.overflown());
        Fault fault;
        CHECK(placing.verify(block.size(), fault) == Status::block_too_small);
        CHECK(fault.value == double(missing));
        CHECK(block.untouched());
    }
}

TEST_CASE("sizes beyond all addresses are refused; they do not wrap round") {
    Size const most = std::numeric_limits<Size>::max();
    for (Size const n : {most, most / 2, most / 8, most / 8 + 1, most / 16 + 1}) {
        Arena counting;
        Span<double> array, more;
        counting.take(array, n);
        counting.take(more, 1);
        CHECK(counting.overflown());
        Fault fault;
        CHECK(counting.verify(0, fault) == Status::bad_argument);
        Guarded block(1000);
        Arena placing(block.data(), block.size());
        placing.take(array, n);
        placing.take(more, 1);
        CHECK(placing.overflown());
        CHECK(array.empty());
        CHECK(more.empty());
        CHECK(placing.verify(1000, fault) == Status::block_too_small);
    }
    Arena negative;
    Span<double> array;
    negative.take(array, -1);  // a count that has overflown before
    CHECK(negative.overflown());
}

TEST_CASE("memory that is released counts by its peak") {
    Arena arena;
    Span<char> array;
    auto const mark = arena.mark();
    arena.take(array, 1000);
    arena.release(mark);
    arena.take(array, 10);
    CHECK(arena.used() == 1024);
    arena.release(mark);
    arena.take(array, 5000);
    CHECK(arena.used() == 5056);
}

TEST_CASE("offsets in an arena at an origin do not depend on the address") {
    Guarded block(4000, 8);
    Arena arena = Arena::at_origin(block.data(), block.size());
    Span<double> a, b;
    arena.take(a, 3);
    arena.take(b, 3);
    CHECK(reinterpret_cast<unsigned char*>(a.data()) == block.data());
    CHECK(reinterpret_cast<unsigned char*>(b.data()) == block.data() + 64);
}
