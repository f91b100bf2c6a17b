#include "formats/bytes.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <cstdint>

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

namespace {

constexpr std::string_view digits_of_64 =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

int digit_of_64(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

}  // namespace

bool decode_base64(std::string_view text, std::size_t& at, std::size_t n, std::string& to) {
    const std::size_t wanted = to.size() + n;
    while (to.size() < wanted) {
        std::uint32_t bits = 0;
        int characters = 0, padding = 0;
        for (; characters < 4; ++at) {
            if (at >= text.size()) return false;
            const char c = text[at];
            if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
            const int digit = digit_of_64(c);
            padding += c == '=' ? 1 : 0;
            if ((digit < 0 && c != '=') || (digit >= 0 && padding > 0)) return false;
            bits = bits << 6 | static_cast<std::uint32_t>(digit < 0 ? 0 : digit);
            ++characters;
        }
        if (padding > 2) return false;
        for (int k = 0; k < 3 - padding; ++k) to += static_cast<char>(bits >> (16 - 8 * k) & 0xff);
    }
    return true;
}

std::string encode_base64(std::string_view bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t bits = 0;
        const std::size_t n = bytes.size() - at < 3 ? bytes.size() - at : 3;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < n ? static_cast<unsigned char>(bytes[at + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= n ? digits_of_64[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace cli
