#include "formats/plain_rows.hpp"

#include "basics/numbers.hpp"

namespace cli {

bool PlainRow::real(double& value) {
    const std::size_t n = parse_front({at_, static_cast<std::size_t>(end_ - at_)}, value);
    at_ += n;
    if (n == 0 || !ends_word()) return false;
    over_blanks();
    return true;
}

}  // namespace cli
