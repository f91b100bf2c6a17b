#include "sampling/npz.hpp"

#include "formats/bytes.hpp"

#include <array>

namespace cli {

namespace {

// The polynomial of the check sum, with the coefficient of x^31 in the lowest bit.
constexpr std::uint32_t sum_polynomial = 0xedb88320u;

// Tables for eight bytes at once: row k is for a byte that k zero bytes follow.
using Tables = std::array<std::array<std::uint32_t, 256>, 8>;

constexpr Tables make_tables() {
    Tables sum_tables = {};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        std::uint32_t sum = byte;
        for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1) != 0 ? sum_polynomial : 0);
        sum_tables[0][byte] = sum;
    }
    for (std::size_t row = 1; row < 8; ++row)
        for (std::size_t byte = 0; byte < 256; ++byte) {
            const std::uint32_t sum = sum_tables[row - 1][byte];
            sum_tables[row][byte] = (sum >> 8) ^ sum_tables[0][sum & 0xff];
        }
    return sum_tables;
}

constexpr Tables sum_tables = make_tables();

// Returns the product of two polynomials modulo that of the check sum.
std::uint32_t sum_product(std::uint32_t a, std::uint32_t b) {
    std::uint32_t sum = 0;
    for (std::uint32_t bit = 0x80000000u; bit != 0; bit >>= 1) {
        if ((a & bit) != 0) sum ^= b;
        b = (b >> 1) ^ ((b & 1) != 0 ? sum_polynomial : 0);
    }
    return sum;
}

std::uint32_t after_eight(std::uint32_t sum, const unsigned char* at) {
    const std::uint32_t low =
        sum ^ (at[0] | at[1] * 0x100u | at[2] * 0x10000u | at[3] * 0x1000000u);
    return sum_tables[7][low & 0xff] ^ sum_tables[6][(low >> 8) & 0xff] ^
           sum_tables[5][(low >> 16) & 0xff] ^ sum_tables[4][low >> 24] ^ sum_tables[3][at[4]] ^
           sum_tables[2][at[5]] ^ sum_tables[1][at[6]] ^ sum_tables[0][at[7]];
}

}  // namespace

std::uint32_t crc32_of(std::uint32_t earlier, const void* data, std::size_t size) {
    const auto* at = static_cast<const unsigned char*>(data);
    std::uint32_t sum = ~earlier;
    // Each step depends on the preceding one. Both halves of long data are therefore computed in
    // the same loop.
    constexpr std::size_t long_enough = 1 << 13;
    if (size >= long_enough) {
        const std::size_t half = size / 16 * 8;
        std::uint32_t second = ~std::uint32_t{0};
        for (std::size_t k = 0; k < half; k += 8) {
            sum = after_eight(sum, at + k);
            second = after_eight(second, at + half + k);
        }
        sum = ~crc32_joined(~sum, ~second, half);
        at += 2 * half;
        size -= 2 * half;
    }
    for (; size >= 8; size -= 8, at += 8) sum = after_eight(sum, at);
    for (; size > 0; --size, ++at) sum = (sum >> 8) ^ sum_tables[0][(sum ^ *at) & 0xff];
    return ~sum;
}

std::uint32_t crc32_joined(std::uint32_t first, std::uint32_t second, std::uint64_t size) {
    std::uint32_t square = 0x00800000u, power = 0x80000000u;  // x^8 and 1
    for (; size != 0; size >>= 1) {
        if ((size & 1) != 0) power = sum_product(power, square);
        square = sum_product(square, square);
    }
    return sum_product(power, first) ^ second;
}

namespace {

// Sizes of headers of ZIP files, which PKWARE's APPNOTE.TXT describes, without the name that
// follows.
constexpr std::uint64_t local_header = 30 + 20;  // with the sizes of 64 bits
constexpr std::uint64_t array_header = 192;

class LittleEndian {
public:
    LittleEndian& put(std::uint64_t value, int bytes) {
        for (int k = 0; k < bytes; ++k) text += static_cast<char>((value >> (8 * k)) & 0xff);
        return *this;
    }
    LittleEndian& put(const std::string& bytes) {
        text += bytes;
        return *this;
    }
    std::string text;
};

char order_of_bytes() { return little_endian_machine() ? '<' : '>'; }

std::string in_npy(const std::string& type, const NpzWriter::Shape& shape) {
    std::string sizes;
    for (const std::uint64_t size : shape) sizes += std::to_string(size) + ",";
    std::string text =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + sizes + ")}";
    text.resize(array_header - 10 - 1, ' ');
    LittleEndian head;
    head.put("\x93NUMPY").put(1, 1).put(0, 1).put(array_header - 10, 2).put(text + '\n');
    return head.text;
}

// Version, flags, method, time and date: ZIP 4.5, not compressed, 1 January 1980.
LittleEndian& put_kind(LittleEndian& to) {
    return to.put(45, 2).put(0, 2).put(0, 2).put(0, 2).put(0x21, 2);
}

constexpr std::uint64_t elsewhere = 0xffffffffu;  // the size is in the field of 64 bits

}  // namespace

void NpzWriter::write(const void* data, std::size_t size) {
    out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    place_ += size;
}

void NpzWriter::write_local_header(const Entry& entry) {
    LittleEndian head;
    put_kind(head.put(0x04034b50u, 4)).put(entry.sum, 4).put(elsewhere, 4).put(elsewhere, 4);
    head.put(entry.name.size(), 2).put(20, 2).put(entry.name);
    head.put(1, 2).put(16, 2).put(entry.size, 8).put(entry.size, 8);
    out_.write(head.text.data(), static_cast<std::streamsize>(head.text.size()));
}

void NpzWriter::open(const std::string& name) {
    entries_.push_back({name + ".npy", place_, 0, 0});
    write_local_header(entries_.back());
    place_ += local_header + entries_.back().name.size();
}

void NpzWriter::add_bytes(const std::string& name, const std::string& type, const Shape& shape,
                          const void* data, std::size_t size) {
    const std::string head = in_npy(type, shape);
    Entry entry = {name + ".npy", place_, head.size() + size, 0};
    entry.sum = crc32_of(crc32_of(0, head.data(), head.size()), data, size);
    write_local_header(entry);
    place_ += local_header + entry.name.size();
    write(head.data(), head.size());
    write(data, size);
    entries_.push_back(entry);
}

void NpzWriter::add(const std::string& name, const std::vector<double>& values,
                    const Shape& shape) {
    add_bytes(name, std::string(1, order_of_bytes()) + "f8", shape, values.data(),
              values.size() * sizeof(double));
}

void NpzWriter::add(const std::string& name, const std::vector<std::int32_t>& values,
                    const Shape& shape) {
    add_bytes(name, std::string(1, order_of_bytes()) + "i4", shape, values.data(),
              values.size() * sizeof(std::int32_t));
}

void NpzWriter::add(const std::string& name, const std::vector<std::uint8_t>& values,
                    const Shape& shape) {
    add_bytes(name, "|u1", shape, values.data(), values.size());
}

void NpzWriter::begin(const std::string& name, const Shape& row) {
    row_ = row;
    open(name);
    const std::string space(array_header, ' ');  // end() writes the header of the array here
    write(space.data(), space.size());
}

void NpzWriter::append(const std::vector<double>& values) {
    Entry& entry = entries_.back();
    const std::size_t size = values.size() * sizeof(double);
    entry.sum = crc32_of(entry.sum, values.data(), size);
    entry.size += size;
    write(values.data(), size);
}

void NpzWriter::end(std::uint64_t rows) {
    Entry& entry = entries_.back();
    Shape shape = {rows};
    shape.insert(shape.end(), row_.begin(), row_.end());
    const std::string head = in_npy(std::string(1, order_of_bytes()) + "f8", shape);
    entry.sum = crc32_joined(crc32_of(0, head.data(), head.size()), entry.sum, entry.size);
    entry.size += head.size();
    out_.seekp(static_cast<std::streamoff>(entry.offset));
    write_local_header(entry);
    out_.write(head.data(), static_cast<std::streamsize>(head.size()));
    out_.seekp(static_cast<std::streamoff>(place_));
}

void NpzWriter::finish() {
    const std::uint64_t begin = place_;
    LittleEndian all;
    for (const Entry& entry : entries_) {
        put_kind(all.put(0x02014b50u, 4).put(45, 2)).put(entry.sum, 4);
        all.put(elsewhere, 4).put(elsewhere, 4).put(entry.name.size(), 2).put(28, 2).put(0, 2);
        all.put(0, 2).put(0, 2).put(0, 4).put(elsewhere, 4).put(entry.name);
        all.put(1, 2).put(24, 2).put(entry.size, 8).put(entry.size, 8).put(entry.offset, 8);
    }
    const std::uint64_t size = all.text.size(), n = entries_.size();
    all.put(0x06064b50u, 4).put(44, 8).put(45, 2).put(45, 2).put(0, 4).put(0, 4);
    all.put(n, 8).put(n, 8).put(size, 8).put(begin, 8);
    all.put(0x07064b50u, 4).put(0, 4).put(begin + size, 8).put(1, 4);
    all.put(0x06054b50u, 4).put(0, 2).put(0, 2).put(0xffff, 2).put(0xffff, 2);
    all.put(elsewhere, 4).put(elsewhere, 4).put(0, 2);
    write(all.text.data(), all.text.size());
}

}  // namespace cli
