#include "basics/mapped_file.hpp"

#include "basics/failure.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#ifndef _WIN32
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
#ifndef _WIN32
    struct stat status;
    if (fstat(file.number(), &status) != 0) file.fail();
    if (S_ISREG(status.st_mode) && status.st_size > 0) {
        size_ = static_cast<std::size_t>(status.st_size);
        mapped_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file.number(), 0);
        if (mapped_ != MAP_FAILED) return;
        mapped_ = nullptr;
    }
#endif
    for (size_ = 0;;) {
        read_.resize(std::max<std::size_t>(2 * size_, 1 << 16));
        const ssize_t more = read(file.number(), &read_[size_], read_.size() - size_);
        if (more < 0 && errno != EINTR) file.fail();
        if (more == 0) return;
        if (more > 0) size_ += static_cast<std::size_t>(more);
    }
}

MappedFile::~MappedFile() {
#ifndef _WIN32
    if (mapped_) munmap(mapped_, size_);
#endif
}

}  // namespace cli
