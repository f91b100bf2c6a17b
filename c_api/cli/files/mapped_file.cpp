#include "files/mapped_file.hpp"

#include "basics/failure.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#if !defined(_WIN32) && !defined(HARMORPH_READS_FILES)
#define HARMORPH_MAPS_FILES
#include "files/ended_reading.hpp"

#include <sys/mman.h>
#endif

namespace cli {

namespace {

#ifdef O_BINARY
constexpr int as_bytes = O_RDONLY | O_BINARY;
#else
constexpr int as_bytes = O_RDONLY;
#endif

class Opened {
public:
    explicit Opened(const std::string& path) : path_(path), number_(open(path.c_str(), as_bytes)) {
        if (number_ < 0) fail();
    }
    ~Opened() { close(number_); }
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;

    int number() const { return number_; }
    [[noreturn]] void fail() const {
        throw Failure(exit_file, path_ + ": cannot be read: " + std::strerror(errno));
    }

private:
    const std::string& path_;
    int number_;
};

}  // namespace

MappedFile::MappedFile(const std::string& path) {
    const Opened file(path);
    struct stat status;
    if (fstat(file.number(), &status) != 0) file.fail();
    const bool is_regular = (status.st_mode & S_IFMT) == S_IFREG && status.st_size > 0;
#ifdef HARMORPH_MAPS_FILES
    if (is_regular) {
        size_ = static_cast<std::size_t>(status.st_size);
        mapped_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.number(), 0);
        if (mapped_ != MAP_FAILED) {
            watch_mapping(mapped_, size_, path);
            return;
        }
        mapped_ = nullptr;
    }
#endif
    // One byte more than a regular file has tells that the file has ended.
    constexpr std::size_t at_first = 1 << 16;
    std::size_t room = is_regular ? static_cast<std::size_t>(status.st_size) + 1 : at_first;
    for (size_ = 0;;) {
        if (size_ == read_.size()) {
            read_.resize(room);
            room = 2 * read_.size();
        }
        const ssize_t more = read(file.number(), &read_[size_], read_.size() - size_);
        if (more < 0 && errno != EINTR) file.fail();
        if (more == 0) return;
        if (more > 0) size_ += static_cast<std::size_t>(more);
    }
}

MappedFile::~MappedFile() {
#ifdef HARMORPH_MAPS_FILES
    if (mapped_ == nullptr) return;
    forget_mapping(mapped_);
    munmap(mapped_, size_);
#endif
}

}  // namespace cli
