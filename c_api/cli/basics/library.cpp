#include "basics/library.hpp"

#include <new>

namespace cli {

void Block::resize(std::size_t bytes) {
    if (!memory_ || bytes > capacity_) {
        memory_.reset();  // before the allocation, so that both blocks never exist together
        data_ = nullptr;
        capacity_ = 0;
        memory_.reset(std::malloc(hm_pages_room(bytes)));
        if (!memory_) throw std::bad_alloc();
        data_ = static_cast<unsigned char*>(hm_pages_place(memory_.get(), bytes));
        capacity_ = bytes;
    }
    size_ = bytes;
}

ExitCode exit_code(hm_status status) {
    switch (status) {
        case HM_BAD_MESH:
        case HM_BAD_CURVE:
        case HM_BAD_BASIS: return exit_file;
        case HM_BAD_ARGUMENT:
        case HM_BAD_CONDITION:
        case HM_UNSUPPORTED: return exit_usage;
        default: return exit_unusable;
    }
}

void refuse(const hm_error& error, const std::string& path) {
    throw Failure(exit_code(error.code), path + ": " + error.text);
}

}  // namespace cli
