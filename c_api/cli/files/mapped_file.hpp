// A file whose bytes are in memory. A regular file is mapped, so that its bytes are neither copied
// nor kept twice; other files, such as pipes, are read. If another program shortens a mapped file,
// this program ends with a message and exit code 3 (ended_reading.hpp). Where these sources are a
// part of another process, HARMORPH_READS_FILES is defined: then every file is read, so that later
// changes of the file cannot be seen.
#pragma once

#include <cstddef>
#include <string>

namespace cli {

class MappedFile {
public:
    explicit MappedFile(const std::string& path);  // throws a Failure if the file cannot be read
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    const char* data() const { return mapped_ ? static_cast<const char*>(mapped_) : read_.data(); }
    std::size_t size() const { return size_; }

private:
    void* mapped_ = nullptr;
    std::size_t size_ = 0;
    std::string read_;  // the bytes of a file that cannot be mapped
};

}  // namespace cli
