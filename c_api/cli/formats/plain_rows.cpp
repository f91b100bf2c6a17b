#include "formats/plain_rows.hpp"

#include "basics/numbers.hpp"

#include <charconv>
#include <cmath>

namespace cli {

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

}  // namespace cli
