#include "formats/bytes.hpp"

#include "basics/numbers.hpp"

#include <algorithm>

namespace cli {

namespace {

template <class Number>
void store(char* bytes, Number value, bool swapped) {
    std::memcpy(bytes, &value, sizeof value);
    if (swapped) std::reverse(bytes, bytes + sizeof value);
}

bool is_of_number(char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E' ||
           c == 'd' || c == 'D';
}

}  // namespace

std::size_t number_length(const Mesh& mesh, std::size_t offset) {
    switch (mesh.in_file.kind) {
        case NumberKind::real32: return 4;
        case NumberKind::real64: return 8;
        case NumberKind::text: break;
    }
    const std::string_view text = mesh.file.text();
    std::size_t end = offset;
    while (end < text.size() && is_of_number(text[end])) ++end;
    return end - offset;
}

std::size_t next_number(const Mesh& mesh, std::size_t end) {
    if (mesh.in_file.kind != NumberKind::text) return end;
    return std::min(mesh.file.text().find_first_not_of(blanks, end), mesh.file.text().size());
}

double read_number(const Mesh& mesh, std::size_t offset) {
    const char* bytes = mesh.file.text().data() + offset;
    const bool swapped = mesh.in_file.swapped;
    switch (mesh.in_file.kind) {
        case NumberKind::real32: return static_cast<double>(load<float>(bytes, swapped));
        case NumberKind::real64: return load<double>(bytes, swapped);
        case NumberKind::text: break;
    }
    double value = 0;
    parse({bytes, number_length(mesh, offset)}, value);
    return value;
}

void store_real(char* bytes, double value, const FileCoordinates& as) {
    if (as.kind == NumberKind::real32) {
        store(bytes, static_cast<float>(value), as.swapped);
    } else {
        store(bytes, value, as.swapped);
    }
}

}  // namespace cli
