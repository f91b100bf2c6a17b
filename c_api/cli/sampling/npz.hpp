// Writes .npz files: ZIP files of arrays in NumPy's format .npy, not compressed, with sizes of 64
// bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace cli {

// The check sum of ZIP files (CRC-32 of ISO 3309).

// Returns the check sum of earlier bytes (0 if there are none) continued by these bytes.
std::uint32_t crc32_of(std::uint32_t earlier, const void* data, std::size_t size);

// Returns the check sum of two pieces of data, one after the other. size: bytes of the second one.
std::uint32_t crc32_joined(std::uint32_t first, std::uint32_t second, std::uint64_t size);

class NpzWriter {
public:
    using Shape = std::vector<std::uint64_t>;

    // The stream must be able to go back to earlier places, and outlive the writer.
    explicit NpzWriter(std::ostream& out) : out_(out) {}
    NpzWriter(const NpzWriter&) = delete;

    void add(const std::string& name, const std::vector<double>& values, const Shape& shape);
    void add(const std::string& name, const std::vector<std::int32_t>& values, const Shape& shape);
    void add(const std::string& name, const std::vector<std::uint8_t>& values, const Shape& shape);

    // Writes an array of real numbers row by row; `row` is the shape of one row. No other array may
    // be added before the end.
    void begin(const std::string& name, const Shape& row);
    void append(const std::vector<double>& values);
    void end(std::uint64_t rows);

    void finish();  // writes the directory of the ZIP file

private:
    struct Entry {
        std::string name;
        std::uint64_t offset = 0, size = 0;
        std::uint32_t sum = 0;
    };
    void add_bytes(const std::string& name, const std::string& type, const Shape& shape,
                   const void* data, std::size_t size);
    void open(const std::string& name);
    void write(const void* data, std::size_t size);
    void write_local_header(const Entry& entry);

    std::ostream& out_;
    std::uint64_t place_ = 0;
    std::vector<Entry> entries_;
    Shape row_;
};

}  // namespace cli
