#include "sampling/sample_summary.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

std::string without_numbers(const std::string& reason) {
    std::string out;
    bool in_number = false;
    for (const char c : reason) {
        const bool is_digit = c >= '0' && c <= '9';
        const bool continues = in_number && (c == '.' || c == 'e' || c == '-' || c == '+');
        if (!is_digit && !continues) out += c;
        else if (!in_number) out += '#';
        in_number = is_digit || continues;
    }
    return out;
}

}  // namespace

void SampleSummary::add(const SampleRow& row) {
    ++designs;
    if (!row.is_accepted()) {
        const std::string reason =
            row.section.empty() ? without_numbers(row.reason) : "the section cannot be taken";
        const bool is_new = reasons.count(reason) == 0;
        ++reasons[is_new && reasons.size() >= most_reasons ? "other reasons" : reason];
        return;
    }
    ++ways[row.way];
    ++splits[row.split];
    least.resize(row.numbers.size(), unknown);
    most.resize(row.numbers.size(), unknown);
    for (std::size_t k = 0; k < row.numbers.size(); ++k) {
        least[k] = std::fmin(least[k], row.numbers[k]);
        most[k] = std::fmax(most[k], row.numbers[k]);
    }
    if (accepted++ % stride_ != 0) return;
    rows.push_back(row);
    if (rows.size() < 2 * most_rows) return;
    std::vector<SampleRow> kept;
    for (std::size_t k = 0; k < rows.size(); k += 2) kept.push_back(rows[k]);
    rows.swap(kept);
    stride_ *= 2;
}

}  // namespace cli
