// How a text file writes its numbers: found from all of them, so that others can be written the
// same way.
#pragma once

#include <string>
#include <string_view>

namespace cli {

class NumberStyle {
public:
    void see(std::string_view word);  // a number of the file

    // Digits are at least those of the file, and so many that the error is at most `tolerance`; 17
    // read back as the same bits.
    std::string print(double value, double tolerance) const;

private:
    bool fixed() const;
    bool scientific() const;
    int digits() const;  // significant; after the point where fixed

    long words_ = 0, with_exponent_ = 0, leading_zero_ = 0;
    int least_decimals_ = 1000, most_decimals_ = 0, most_digits_ = 0;
    char exponent_ = 'e';
};

}  // namespace cli
