#include "sampling/design_values.hpp"

#include "basics/numbers.hpp"
#include "files/text_file.hpp"

#include <algorithm>

namespace cli {

namespace {

std::size_t place_of(const std::vector<DesignParameter>& parameters, std::string_view name,
                     const LineReader& lines) {
    for (std::size_t k = 0; k < parameters.size(); ++k)
        if (parameters[k].name == name) return k;
    const std::string names =
        parameters.empty() ? "none" : parameters.front().name + " .. " + parameters.back().name;
    lines.expected("a parameter of the designs (" + names + ")", name);
}

double number_of(const LineReader& lines, std::string_view word) {
    double number = 0;
    if (!parse(word, number)) lines.expected("a finite number", word);
    return number;
}

// Names may be in quotation marks, as many programs write them; they have no commas.
std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> cells;
    while (!line.empty()) {
        const std::size_t end = std::min(line.find_first_of(", \t"), line.size());
        std::string_view cell = line.substr(0, end);
        if (cell.size() > 2 && cell.front() == '"' && cell.back() == '"')
            cell = cell.substr(1, cell.size() - 2);
        if (!cell.empty()) cells.push_back(cell);
        line.remove_prefix(std::min(end + 1, line.size()));
    }
    return cells;
}

}  // namespace

DesignValues DesignValues::of_sequence(std::vector<DesignParameter> parameters, Sequence sequence,
                                       std::int64_t n, std::uint64_t seed) {
    DesignValues out;
    const auto varies = [](const DesignParameter& one) { return one.low < one.high; };
    const auto dimensions =
        static_cast<std::size_t>(std::count_if(parameters.begin(), parameters.end(), varies));
    out.parameters_ = std::move(parameters);
    out.count_ = n;
    if (sequence == Sequence::sobol) out.sobol_.emplace(dimensions, seed);
    else out.latin_.emplace(static_cast<std::uint64_t>(n), seed);
    return out;
}

DesignValues DesignValues::of_table(const std::string& path,
                                    std::vector<DesignParameter> parameters) {
    const TextFile file(path);
    LineReader lines(file, '#');
    DesignValues out;
    if (!lines.next()) lines.expected("a line with the names of parameters");
    std::vector<std::size_t> columns;
    for (const std::string_view name : words_of(lines.line())) {
        columns.push_back(place_of(parameters, name, lines));
        if (std::count(columns.begin(), columns.end(), columns.back()) > 1)
            lines.fail("the parameter " + std::string(name) + " has two columns");
    }
    for (DesignParameter& one : parameters) one.low = one.high = 0;
    while (lines.next()) {
        const std::vector<std::string_view> cells = words_of(lines.line());
        if (cells.size() != columns.size())
            lines.expected(plural(std::int64_t(columns.size()), "number"));
        std::vector<double> row(parameters.size());
        for (std::size_t k = 0; k < cells.size(); ++k) row[columns[k]] = number_of(lines, cells[k]);
        for (std::size_t k = 0; k < row.size(); ++k) {
            DesignParameter& one = parameters[k];
            one.low = out.count_ == 0 ? row[k] : std::min(one.low, row[k]);
            one.high = out.count_ == 0 ? row[k] : std::max(one.high, row[k]);
        }
        out.table_.insert(out.table_.end(), row.begin(), row.end());
        ++out.count_;
    }
    out.parameters_ = std::move(parameters);
    return out;
}

std::vector<double> DesignValues::values(std::int64_t design) const {
    const std::size_t n = parameters_.size();
    if (!sobol_ && !latin_) {
        const auto row = table_.begin() + static_cast<std::ptrdiff_t>(n) * design;
        return {row, row + static_cast<std::ptrdiff_t>(n)};
    }
    const auto index = static_cast<std::uint64_t>(design);
    std::vector<double> out;
    std::size_t dimension = 0;
    for (const DesignParameter& one : parameters_) {
        double share = 0;
        if (one.low < one.high) {
            share = sobol_ ? sobol_->at(index, dimension) : latin_->at(index, dimension);
            ++dimension;
        }
        out.push_back(one.low + share * (one.high - one.low));
    }
    return out;
}

void read_ranges(const std::string& path, std::vector<DesignParameter>& parameters) {
    const TextFile file(path);
    LineReader lines(file, '#');
    std::vector<bool> named(parameters.size());
    while (lines.next()) {
        if (lines.words().size() != 3) lines.expected("the name of a parameter, low, high");
        const std::size_t k = place_of(parameters, lines.words()[0], lines);
        const double low = number_of(lines, lines.words()[1]),
                     high = number_of(lines, lines.words()[2]);
        if (named[k]) lines.fail("the parameter " + parameters[k].name + " has a range already");
        if (low > high) lines.fail("the lower end of the range is above the upper end");
        named[k] = true;
        parameters[k].low = low;
        parameters[k].high = high;
    }
}

}  // namespace cli
