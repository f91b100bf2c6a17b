#include "sampling/npz.hpp"

#include "formats/bytes.hpp"
#include "sampling/crc32.hpp"

namespace cli {

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
