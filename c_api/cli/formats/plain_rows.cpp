#include "formats/plain_rows.hpp"

#include "basics/numbers.hpp"

#include <charconv>
#include <cmath>

namespace cli {

bool PlainRow::whole(std::int32_t& value) {
    constexpr int most_digits = 9;  // every such number fits
    const char* const first = at_;
    std::int32_t read = 0;
    for (; at_digit() && at_ - first < most_digits; ++at_) read = 10 * read + (*at_ - '0');
    if (at_ == first || !ends_word()) return false;
    value = read;
    over_blanks();
    return true;
}

bool PlainRow::real(double& value) {
#if defined(__cpp_lib_to_chars)
    const auto result = std::from_chars(at_, end_, value);
    if (result.ec != std::errc() || !std::isfinite(value)) return false;
    at_ = result.ptr;
#else
    const char* const first = at_;
    while (at_ < end_ && !ends_word()) ++at_;
    if (!parse({first, static_cast<std::size_t>(at_ - first)}, value)) return false;
#endif
    if (!ends_word()) return false;
    over_blanks();
    return true;
}

bool PlainRow::end_of_line() {
    if (at_ < end_ && *at_ == '\r') ++at_;
    if (at_ == end_ || *at_ != '\n') return false;
    ++at_;
    return true;
}

}  // namespace cli
