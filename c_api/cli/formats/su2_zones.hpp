// The zones of an SU2 file, of which one is read (NZONE= and IZONE=).
#pragma once

#include "files/text_file.hpp"

#include <cstdint>
#include <string>

namespace cli {

class Su2Zones {
public:
    // chosen: the number of the zone to read, or empty if the file must have only one.
    explicit Su2Zones(const std::string& chosen) : chosen_(chosen) {}

    void choose(const LineReader& lines, std::int32_t count);  // at NZONE=
    // At IZONE=. Returns whether this zone is the one to read. Refuses zones that are not numbered
    // 1, 2, ...
    bool begin(const LineReader& lines, std::int32_t zone);
    bool has_begun() const { return begun_ > 0; }
    void check_complete(const TextFile& file) const;  // at the end of the file

private:
    const std::string& chosen_;
    std::int32_t count_ = 1, number_ = 1, begun_ = 0;
    std::size_t line_ = 0;  // the place of NZONE=
};

}  // namespace cli
