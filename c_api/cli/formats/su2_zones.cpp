#include "formats/su2_zones.hpp"

#include "basics/failure.hpp"
#include "basics/numbers.hpp"

namespace cli {

void Su2Zones::choose(const LineReader& lines, std::int32_t count) {
    count_ = count;
    line_ = lines.offset();
    if (chosen_.empty() && count_ > 1) {
        lines.fail("the file has " + std::to_string(count_) +
                   " zones; choose one with --zone (the others stay as they are)");
    }
    if (chosen_.empty()) return;
    if (!parse(chosen_, number_) || number_ < 1 || number_ > count_) {
        throw Failure(exit_usage, "--zone expects a number between 1 and " +
                                      std::to_string(count_) + ", not " + in_quotes(chosen_));
    }
}

bool Su2Zones::begin(const LineReader& lines, std::int32_t zone) {
    if (zone != ++begun_ || zone > count_) {
        lines.expected("IZONE= " + std::to_string(begun_) + " of the " + plural(count_, "zone") +
                       " that NZONE= announces");
    }
    return zone == number_;
}

void Su2Zones::check_complete(const TextFile& file) const {
    if (count_ <= 1 || begun_ >= count_) return;
    file.fail(line_, "NZONE= announces " + std::to_string(count_) + " zones, but the file has " +
                         plural(begun_, "line") + " IZONE=");
}

}  // namespace cli
