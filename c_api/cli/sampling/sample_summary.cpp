#include "sampling/sample_summary.hpp"

#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"

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
        ++reasons[is_new && reasons.size() >= max_reasons ? "other reasons" : reason];
        return;
    }
    ++ways[row.way];
    ++splits[row.split];
    min.resize(row.numbers.size(), unknown);
    max.resize(row.numbers.size(), unknown);
    for (std::size_t k = 0; k < row.numbers.size(); ++k) {
        min[k] = std::fmin(min[k], row.numbers[k]);
        max[k] = std::fmax(max[k], row.numbers[k]);
    }
    if (accepted++ % stride_ != 0) return;
    rows.push_back(row);
    if (rows.size() < 2 * max_rows) return;
    std::vector<SampleRow> kept;
    for (std::size_t k = 0; k < rows.size(); k += 2) kept.push_back(rows[k]);
    rows.swap(kept);
    stride_ *= 2;
}

void print_summary(const SampleSummary& summary, const SampleRun& run) {
    print("designs          %lld, of which %lld are accepted, in %s\n",
          static_cast<long long>(summary.designs), static_cast<long long>(summary.accepted),
          plural(run.shards, "shard").c_str());
    for (const auto& one : summary.ways)
        print("%-16s %s\n", one.first.c_str(), plural(one.second, "design").c_str());
    for (const auto& one : summary.reasons)
        print("rejected         %lld: %s\n", static_cast<long long>(one.second), one.first.c_str());
    if (run.designs > 0)
        print("time             %s s, %s designs a second\n", brief(run.seconds).c_str(),
              brief(double(run.designs) / run.seconds).c_str());
    if (summary.accepted == 0) warn("no design is accepted: designs.csv has the reasons");
}

void print_json(const SampleSummary& summary, const SampleRun& run) {
    JsonObject object;
    object.add("designs", summary.designs).add("accepted", summary.accepted);
    object.add("shards", run.shards).add("continued_at", run.first);
    object.add("seconds", run.seconds);
    for (const char* const way : {"linear", "other", "substeps", "untangled", "improved"}) {
        const auto found = summary.ways.find(way);
        object.add(way, found == summary.ways.end() ? std::int64_t{0} : found->second);
    }
    print("%s\n", object.text().c_str());
}

}  // namespace cli
