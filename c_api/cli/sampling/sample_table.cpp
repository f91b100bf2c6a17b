#include "sampling/sample_table.hpp"

#include "basics/numbers.hpp"
#include "basics/text_out.hpp"
#include "files/text_file.hpp"
#include "sampling/design_values.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace cli {

namespace {

constexpr std::size_t cells_before_numbers = 6, cells_after_numbers = 2;

std::string text_cell(const std::string& text) { return text.empty() ? text : csv_cell(text); }

}  // namespace

SampleTable::SampleTable(const DesignSpace& space, const std::vector<std::string>& measures,
                         bool has_step)
    : has_fit_(space.has_sections()), has_step_(has_step) {
    numbers_ = {"min_quality", "mean_quality"};
    if (has_step_) numbers_.push_back("admissible_step");
    if (has_fit_) numbers_.push_back("fit_error");
    numbers_.insert(numbers_.end(), measures.begin(), measures.end());
    for (std::size_t k = 0; k < space.parameters().size(); ++k) {
        const DesignParameter& one = space.parameters()[k];
        if (one.low == 0 && one.high == 0) continue;
        shown_.push_back(k);
        numbers_.push_back(one.name);
    }
}

std::vector<double> SampleTable::numbers_of(const MorphedDesign& result) const {
    std::vector<double> out = {result.min_quality, result.mean_quality};
    if (has_step_) out.push_back(result.admissible_step);
    if (has_fit_) out.push_back(result.design.fit_error < 0 ? unknown : result.design.fit_error);
    out.insert(out.end(), result.measures.begin(), result.measures.end());
    out.resize(first_parameter(), unknown);
    for (const std::size_t k : shown_)
        out.push_back(k < result.design.values.size() ? result.design.values[k] : unknown);
    return out;
}

void SampleTable::write_names(std::ostream& out) const {
    out << "design,accepted,split,shard,row,way";
    for (const std::string& name : numbers_) out << ',' << csv_cell(name);
    out << ",section,reason\n";
}

void SampleTable::write(std::ostream& stream, const SampleRow& row) const {
    std::string text;
    {
        TextOut out(text);
        out << row.design + 1 << ',' << (row.is_accepted() ? '1' : '0') << ',' << row.split << ',';
        if (row.is_accepted()) out << row.shard << ',' << row.row;
        else out << ',';
        out << ',' << row.way;
        for (const double value : row.numbers) {
            out << ',';
            if (std::isinf(value)) out << "inf";
            else if (!std::isnan(value)) out << value;
        }
        out << ',' << text_cell(row.section) << ',' << text_cell(row.reason) << '\n';
    }
    stream << text;
}

void SampleTable::read(const SampleFolder& folder, std::int64_t shards,
                       const std::function<void(const SampleRow&)>& take) const {
    for (std::int64_t shard = 1; shard <= shards; ++shard) {
        const TextFile file(folder.table_of(shard));
        CsvReader records(file);
        for (records.next(); records.next();) {
            const std::vector<std::string>& cells = records.cells();
            const std::size_t offset = records.offset();
            SampleRow row;
            if (cells.size() != cells_before_numbers + numbers_.size() + cells_after_numbers ||
                !parse(cells[0], row.design))
                file.fail(offset, "this is not a line of a table of designs");
            --row.design;
            row.split = cells[2];
            row.shard = shard;
            if (!cells[4].empty() && !parse(cells[4], row.row))
                file.fail(offset, "this is not a line of a table of designs");
            row.way = cells[5];
            for (std::size_t k = 0; k < numbers_.size(); ++k) {
                const std::string& cell = cells[cells_before_numbers + k];
                double value = unknown;
                if (cell == "inf") value = std::numeric_limits<double>::infinity();
                else if (!cell.empty() && !parse(cell, value))
                    file.fail(offset, "this is not a line of a table of designs");
                row.numbers.push_back(value);
            }
            row.section = cells[cells.size() - 2];
            row.reason = cells.back();
            take(row);
        }
    }
}

SampleSplits::SampleSplits(const Arguments& arguments, const std::vector<std::string>& names)
    : test_(arguments.real("--test", .2, 0, 1)),
      seed_(static_cast<std::uint64_t>(arguments.whole("--seed", 1, 0, 1000000000))) {
    for (const std::string& text : arguments.all("--inside")) {
        const auto [name, bound] = arguments.named_numbers("--inside", text, 2, "NAME=LOW,HIGH");
        if (bound[0] > bound[1])
            arguments.refuse("--inside expects NAME=LOW,HIGH, found " + in_quotes(text));
        Range range = {name, 0, bound[0], bound[1]};
        const auto found = std::find(names.begin(), names.end(), range.name);
        if (found == names.end())
            arguments.refuse("--inside: " + in_quotes(range.name) +
                             " is neither a parameter that varies nor a measure");
        range.column = static_cast<std::size_t>(found - names.begin());
        ranges_.push_back(range);
    }
}

std::string SampleSplits::split(std::int64_t design, const std::vector<double>& values) const {
    for (const Range& range : ranges_) {
        const double value = values[range.column];
        if (!(range.low <= value && value <= range.high)) return "out";
    }
    constexpr std::uint64_t purpose = 0x73706c6974;  // so that numbers differ from the sequence
    const double lot =
        unit_number(mixed_bits(mixed_bits(purpose, seed_), static_cast<std::uint64_t>(design)));
    return lot < test_ ? "test" : "train";
}

std::string SampleSplits::description() const {
    std::string text;
    for (const Range& range : ranges_)
        text += "Designs with " + range.name + " outside " + brief(range.low) + " .. " +
                brief(range.high) + " are in the split `out`. ";
    return text + "Each of the other designs is in the split `test` with probability " +
           brief(test_) + " (seed " + std::to_string(seed_) + "), else in `train`.";
}

}  // namespace cli
