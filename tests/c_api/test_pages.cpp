// Huge pages: what is in a block stays, and nothing outside is asked for.
#include <doctest/doctest.h>

#include <harmorph_pages.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

std::size_t misplaced(void* block) { return reinterpret_cast<std::uintptr_t>(block) % huge_page; }

}  // namespace

TEST_CASE("blocks of any size can be written, and large ones begin at a huge page") {
    for (std::size_t const bytes : {std::size_t{1}, std::size_t{1000}, huge_page - 1, huge_page, 3 * huge_page + 5}) {
        void* const block = hm_pages_alloc(bytes);
        REQUIRE(block != nullptr);
        if (bytes >= huge_page) CHECK(misplaced(block) == 0);
        CHECK(misplaced(block) % 64 == 0);
        std::memset(block, 0x5a, bytes);
        hm_pages_free(block);
    }
    hm_pages_free(nullptr);
    CHECK(hm_pages_alloc(SIZE_MAX) == nullptr);
}

TEST_CASE("whole huge pages inside the block are asked for, and the contents stay") {
    std::vector<unsigned char> memory(4 * huge_page);
    for (std::size_t k = 0; k < memory.size(); ++k) memory[k] = static_cast<unsigned char>(k * 7 % 251);
    unsigned char* const first = memory.data() + (huge_page - misplaced(memory.data())) % huge_page;
    // Inside: none, one and two; the system may refuse.
    for (std::size_t const bytes : {huge_page - 1, huge_page, 2 * huge_page + 1}) {
        std::size_t const advised = hm_huge_pages(first, bytes);
        CHECK(advised % huge_page == 0);
        CHECK(advised <= bytes);
    }
    CHECK(hm_huge_pages(first + 1, 2 * huge_page) <= huge_page);
    CHECK(hm_huge_pages(first + 1, huge_page) == 0);
    CHECK(hm_huge_pages(nullptr, 8 * huge_page) == 0);
    CHECK(hm_huge_pages(first, 0) == 0);
    CHECK(hm_huge_pages(first, SIZE_MAX) == 0);
    std::size_t changed = 0;
    for (std::size_t k = 0; k < memory.size(); ++k) changed += memory[k] != static_cast<unsigned char>(k * 7 % 251);
    CHECK(changed == 0);
}
