#include "report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bench {
namespace {

std::string format(const char* how, double number) {
    char text[64];
    std::snprintf(text, sizeof text, how, number);
    return text;
}

// Texts to the left, numbers to the right.
void print_cell(std::string const& text, std::size_t width, bool to_right) {
    std::printf(to_right ? "%*s  " : "%-*s  ", static_cast<int>(width), text.c_str());
}

void print_row(std::vector<Value> const& row, std::vector<std::size_t> const& width) {
    for (std::size_t k = 0; k < row.size(); ++k)
        print_cell(row[k].text, width[k], row[k].is_number);
    std::printf("\n");
}

// Titles of columns of numbers are aligned to the right.
void print_columns(Table const& table, std::vector<std::size_t> const& width,
                   std::vector<Value> const* row) {
    std::printf("\n%s\n", table.title.c_str());
    for (std::size_t k = 0; k < table.columns.size(); ++k)
        print_cell(table.columns[k], width[k], row != nullptr && (*row)[k].is_number);
    std::printf("\n");
}

}  // namespace

Value::Value(double shown, const char* how)
    : text(std::isfinite(shown) ? format(how, shown) : "-"), number(shown), is_number(true) {}

void Table::begin() {
    constexpr std::size_t narrowest = 10;  // rows that are not known yet may be as wide
    for (std::string const& name : columns) width.push_back(std::max(narrowest, name.size()));
    width[0] = 2 * narrowest;
}

void Table::add(std::vector<Value> row) {
    if (!width.empty()) {
        if (rows.empty()) print_columns(*this, width, &row);
        print_row(row, width);
        std::fflush(stdout);
    }
    rows.push_back(std::move(row));
}

void Table::print() const {
    if (width.empty()) {
        std::vector<std::size_t> widest;
        for (std::string const& name : columns) widest.push_back(name.size());
        for (std::vector<Value> const& row : rows)
            for (std::size_t k = 0; k < row.size(); ++k)
                widest[k] = std::max(widest[k], row[k].text.size());
        print_columns(*this, widest, rows.empty() ? nullptr : &rows[0]);
        for (std::vector<Value> const& row : rows) print_row(row, widest);
    }
    for (std::string const& note : notes) std::printf("  %s\n", note.c_str());
    std::fflush(stdout);
}

void Report::fact(std::string const& name, std::string const& text) {
    std::printf("%s: %s\n", name.c_str(), text.c_str());
    std::fflush(stdout);
}

void Report::finish(Table const& table) { table.print(); }

void say(std::string const& text) { std::fprintf(stderr, "... %s\n", text.c_str()); }

}  // namespace bench
