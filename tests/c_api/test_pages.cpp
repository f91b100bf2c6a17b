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

TEST_CASE("blocks of any size are aligned inside the caller's memory, wherever the memory begins") {
    for (std::size_t const bytes :
         {std::size_t{1}, std::size_t{1000}, huge_page - 1, huge_page, 3 * huge_page + 5}) {
        std::size_t const alignment = hm_pages_alignment(bytes), room = hm_pages_room(bytes);
        CHECK(alignment == (bytes < huge_page ? 64 : huge_page));
        std::vector<unsigned char> memory(room + 64);
        for (std::size_t const offset : {0, 1, 8, 63}) {
            auto* const block =
                static_cast<unsigned char*>(hm_pages_place(memory.data() + offset, bytes));
            REQUIRE(block >= memory.data() + offset);
            CHECK(misplaced(block) % alignment == 0);
            CHECK(std::size_t(block - (memory.data() + offset)) <= room - bytes);
            std::memset(block, 0x5a, bytes);
        }
    }
    CHECK(hm_pages_place(nullptr, 3 * huge_page) == nullptr);
    // Sizes that no memory has: no sum goes round.
    CHECK(hm_pages_room(SIZE_MAX) == SIZE_MAX);
    CHECK(hm_pages_room(SIZE_MAX - huge_page) == SIZE_MAX - 1);
}

TEST_CASE("whole huge pages inside the block are asked for, and the contents stay") {
    std::vector<unsigned char> memory(4 * huge_page);
    for (std::size_t k = 0; k < memory.size(); ++k)
        memory[k] = static_cast<unsigned char>(k * 7 % 251);
    unsigned char* const first = memory.data() + (huge_page - misplaced(memory.data())) % huge_page;
    // Inside: none, one and two; the system may refuse.
    for (std::size_t const bytes : {huge_page - 1, huge_page, 2 * huge_page + 1}) {
        std::size_t const asked = hm_pages_ask(first, bytes);
        CHECK(asked % huge_page == 0);
        CHECK(asked <= bytes);
    }
    CHECK(hm_pages_ask(first + 1, 2 * huge_page) <= huge_page);
    CHECK(hm_pages_ask(first + 1, huge_page) == 0);
    CHECK(hm_pages_ask(nullptr, 8 * huge_page) == 0);
    CHECK(hm_pages_ask(first, 0) == 0);
    CHECK(hm_pages_ask(first, SIZE_MAX) == 0);
    std::size_t changed = 0;
    for (std::size_t k = 0; k < memory.size(); ++k)
        changed += memory[k] != static_cast<unsigned char>(k * 7 % 251);
    CHECK(changed == 0);
}
