// The style in which a text file writes numbers. All numbers of the file determine the style, in
// which other numbers are then written.
#pragma once

#include <string>
#include <string_view>

namespace cli {

class NumberStyle {
public:
    void see(std::string_view word);     // takes account of a number of the file
    void see(const NumberStyle& later);  // takes account of all numbers of a later part
    bool needs_tolerance() const;        // false: the file has so many digits that none are added

    // Appends the number with at least as many digits as the file has, and so many that the error
    // is at most `tolerance`. A number with 17 digits is read as the same bits.
    void append(std::string& text, double value, double tolerance) const;

private:
    bool fixed() const;
    bool scientific() const;
    int digits() const;  // significant digits, or digits after the point if all numbers are
                         // written without exponent

    long words_ = 0, with_exponent_ = 0, leading_zero_ = 0;
    int min_decimals_ = 1000, max_decimals_ = 0, max_digits_ = 0;
    char exponent_ = 'e';
};

}  // namespace cli
