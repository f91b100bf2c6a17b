// Tables on the standard output.
#pragma once

#include <string>
#include <vector>

namespace bench {

// A text, or a number and how it is printed. A number that is not finite is printed as "-".
struct Value {
    std::string text;
    double number = 0;
    bool is_number = false;

    Value(std::string shown) : text(std::move(shown)) {}
    Value(const char* shown) : text(shown) {}
    Value(double shown, const char* format);
};

inline Value seconds(double s) { return {s, s < 0.01 ? "%.5f" : s < 10 ? "%.4f" : "%.2f"}; }
inline Value milliseconds(double s) { return {1e3 * s, "%.3f"}; }
inline Value count(double n) { return {n, "%.0f"}; }
inline Value ratio(double r) { return {r, "%.2f"}; }
inline Value percent(double share) { return {100 * share, "%.1f"}; }
inline Value residual(double r) { return {r, "%.1e"}; }

struct Table {
    std::string title;
    std::vector<std::string> columns;
    std::vector<std::vector<Value>> rows;
    std::vector<std::string> notes;
    std::vector<std::size_t> width{};  // of the columns, where rows are printed as they come

    void add(std::vector<Value> row);
    // From now on each row is printed when it is added, after the titles of the columns, because
    // runs are long.
    void begin();
    void print() const;  // what has not been printed yet
};

struct Report {
    // Facts come before all tables: machine, date, compilers, peers.
    void fact(std::string const& name, std::string const& text);
    // Prints a finished table.
    void finish(Table const& table);
};

// Prints what is being measured on the standard error, because runs are long.
void say(std::string const& text);

}  // namespace bench
