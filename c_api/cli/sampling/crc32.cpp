#include "sampling/crc32.hpp"

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

}  // namespace cli
