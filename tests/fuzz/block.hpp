// A block of memory that ends at a page nobody may touch. It holds arbitrary bytes, and begins
// wherever its size and `shift` put its beginning: at all alignments.
#pragma once

#include "failure.hpp"

#include <sys/mman.h>
#include <unistd.h>

#if __has_include(<valgrind/memcheck.h>)
#include <valgrind/memcheck.h>
#else
#define VALGRIND_MAKE_MEM_UNDEFINED(begin, bytes) (void)0
#endif

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace fuzz {

class Block {
public:
    Block(std::size_t bytes, std::size_t shift, int fill) : bytes_(bytes), shift_(shift) {
        std::size_t const page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
        mapped_ = (bytes + shift + page - 1) / page * page + page;
        memory_ = static_cast<unsigned char*>(
            mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
        expect(memory_ != MAP_FAILED && mprotect(memory_ + mapped_ - page, page, PROT_NONE) == 0,
               "no memory");
        end_ = memory_ + mapped_ - page;
        if (fill != 0) std::memset(data(), fill, bytes);
        std::memset(end_ - shift, mark, shift);
        static bool const undefined =
            std::getenv("HARMORPH_UNDEFINED") != nullptr;  // what valgrind is to think of it
        if (undefined) VALGRIND_MAKE_MEM_UNDEFINED(data(), bytes);
    }
    ~Block() { munmap(memory_, mapped_); }
    Block(Block const&) = delete;
    Block& operator=(Block const&) = delete;

    unsigned char* data() const { return end_ - shift_ - bytes_; }
    std::size_t size() const { return bytes_; }
    void expect_intact() const {
        expect(std::all_of(end_ - shift_, end_, [](unsigned char byte) { return byte == mark; }),
               "written behind a block");
    }

private:
    static constexpr unsigned char mark = 0xA5;
    std::size_t bytes_, shift_, mapped_;
    unsigned char *memory_, *end_;
};

}  // namespace fuzz
