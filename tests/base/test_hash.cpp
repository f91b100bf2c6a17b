// Fingerprints of blocks.
#include <doctest/doctest.h>

#include <fixtures/executors.hpp>

#include "base/hash.hpp"

#include <set>

TEST_CASE("hashes distinguish order, zeros, lengths and single bits") {
    auto const hash = [](std::vector<std::uint64_t> const& words) {
        return harmorph::hash_of_block(words.data(), 8 * words.size());
    };
    std::set<std::uint64_t> seen;
    std::size_t n = 0;
    for (std::size_t length = 0; length < 20; ++length, ++n)
        seen.insert(hash(std::vector<std::uint64_t>(length, 0)));
    std::vector<std::uint64_t> words = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    CHECK(hash(words) == hash(words));
    for (std::size_t k = 0; k < words.size(); ++k)
        for (int bit = 0; bit < 64; ++bit, ++n) {
            words[k] ^= std::uint64_t{1} << bit;
            seen.insert(hash(words));
            words[k] ^= std::uint64_t{1} << bit;
        }
    for (std::size_t k = 0; k + 1 < words.size(); ++k)
        for (std::size_t j = k + 1; j < words.size(); ++j, ++n) {
            std::swap(words[k], words[j]);
            seen.insert(hash(words));
            std::swap(words[k], words[j]);
        }
    CHECK(seen.size() == n);
    std::vector<double> const plus = {0.0}, minus = {-0.0};
    CHECK(harmorph::hash_of_block(plus.data(), 8) != harmorph::hash_of_block(minus.data(), 8));
}

TEST_CASE("the hash of a long block depends on the order of its pieces, not on threads") {
    std::size_t const n = 40000;  // more words than a piece has
    std::vector<std::uint64_t> words(n);
    for (std::size_t k = 0; k < n; ++k) words[k] = k * k + 1;
    auto const hash = [&](std::int32_t threads) {
        fixtures::Backwards order;
        hm_executor const executor = order.executor(threads);
        harmorph::Executor const by{executor.run, executor.user, threads};
        std::uint64_t const found = harmorph::hash_of_block(words.data(), 8 * n, by);
        CHECK((order.calls > 0) == (threads > 1));
        return found;
    };
    std::uint64_t const whole = hash(1);
    for (std::int32_t const threads : {2, 3, 8}) CHECK(hash(threads) == whole);
    for (std::size_t const k : {std::size_t{0}, std::size_t{8191}, std::size_t{8192}, n - 1}) {
        words[k] ^= 1;
        CHECK(hash(1) != whole);
        words[k] ^= 1;
    }
    for (std::size_t k = 0; k < 8192; ++k)
        std::swap(words[k], words[k + 16384]);  // two pieces change places
    CHECK(hash(1) != whole);
    CHECK(hash(3) == hash(1));
}
