// Writes the file of a mesh, of any format, with other coordinates.
#include "basics/numbers.hpp"
#include "basics/elementary.hpp"
#include "files/threads.hpp"
#include "formats/bytes.hpp"
#include "formats/format.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

namespace cli {

namespace {

// The style in which a text file writes numbers. All numbers of the file determine the style, in
// which other numbers are then written.

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

constexpr int exact_digits = 17;   // identify any double
constexpr int evident_digits = 6;  // numbers with fewer digits may be round numbers

// C prints 1.23e+02; many Fortran programs print 0.123E+03.
std::string with_leading_zero(const std::string& text) {
    const std::size_t e = text.find('e'), first = text[0] == '-' ? 1 : 0;
    std::string digits =
        text.substr(first, 1) + (first + 2 < e ? text.substr(first + 2, e - first - 2) : "");
    const bool zero = digits.find_first_not_of('0') == std::string::npos;
    std::int32_t exponent = 0;
    if (!zero && parse(text.substr(e + (text[e + 1] == '+' ? 2 : 1)), exponent)) ++exponent;
    return text.substr(0, first) + "0." + digits + (exponent < 0 ? "e-" : "e+") +
           padded(std::abs(exponent), 2, '0');
}

void NumberStyle::see(std::string_view word) {
    int digits = 0, decimals = 0;
    bool after_point = false, has_exponent = false;
    std::size_t at = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
    const char first = at < word.size() ? word[at] : 'e';
    for (; at < word.size(); ++at) {
        const char c = word[at];
        if (c == 'e' || c == 'E' || c == 'd' || c == 'D') {
            has_exponent = true;
            exponent_ = c;
            break;
        }
        if (c == '.') {
            after_point = true;
        } else {
            decimals += after_point ? 1 : 0;
            digits += digits > 0 || c != '0' ? 1 : 0;  // zeros in front do not count
        }
    }
    ++words_;
    if (has_exponent) {
        ++with_exponent_;
        // Zero counts as written in both ways.
        leading_zero_ += digits == 0 || first == '0' || first == '.' ? 1 : 0;
    }
    min_decimals_ = std::min(min_decimals_, decimals);
    max_decimals_ = std::max(max_decimals_, decimals);
    max_digits_ = std::max(max_digits_, digits);
}

void NumberStyle::see(const NumberStyle& later) {
    if (later.with_exponent_ > 0) exponent_ = later.exponent_;
    words_ += later.words_;
    with_exponent_ += later.with_exponent_;
    leading_zero_ += later.leading_zero_;
    min_decimals_ = std::min(min_decimals_, later.min_decimals_);
    max_decimals_ = std::max(max_decimals_, later.max_decimals_);
    max_digits_ = std::max(max_digits_, later.max_digits_);
}

bool NumberStyle::fixed() const {
    return with_exponent_ == 0 && min_decimals_ == max_decimals_ && max_decimals_ >= evident_digits;
}

bool NumberStyle::needs_tolerance() const { return fixed() || digits() < exact_digits; }

bool NumberStyle::scientific() const {
    return with_exponent_ == words_ && max_digits_ >= evident_digits;
}

int NumberStyle::digits() const {
    if (fixed()) return max_decimals_;
    const bool evident = scientific() || max_digits_ > evident_digits + 2;
    return evident ? max_digits_ : exact_digits;
}

void NumberStyle::append(std::string& text, double value, double tolerance) const {
    // Half a unit of the last digit, 0.5 * 10^-decimals, must not be above the tolerance.
    const auto decimals = [&] {
        return -decimal_exponent(2 * std::min(std::max(tolerance, 1e-300), 1e300));
    };
    const auto magnitude = [&](int of_zero) {
        return value == 0 ? of_zero : decimal_exponent(value) + 1;
    };
    if (fixed()) {
        const int wanted =
            std::min(decimals(), exact_digits - std::min(magnitude(0), exact_digits));
        return append_number(text, 'f', std::min(std::max(max_decimals_, wanted), 40), value);
    }
    int significant = digits();
    if (significant < exact_digits)
        significant = std::min(std::max(significant, magnitude(-400) + decimals()), exact_digits);
    significant = std::min(std::max(significant, 1), 40);
    const std::size_t begin = text.size();
    if (!scientific()) {
        append_number(text, 'g', significant, value);
    } else {
        append_number(text, 'e', significant - 1, value);
        if (leading_zero_ == with_exponent_) {
            const std::string number = with_leading_zero(text.substr(begin));
            text.resize(begin);
            text += number;
        }
    }
    if (exponent_ == 'e') return;
    const std::size_t e = text.find('e', begin);
    if (e != std::string::npos) text[e] = exponent_;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Writes the numbers of the file that the moved mesh has changed, and the bytes between them.
class Rewriter {
public:
    Rewriter(const Mesh& mesh, const double* x, const double* y) : mesh_(mesh), x_(x), y_(y) {}

    void write(std::ostream& out) {
        const std::string_view text = mesh_.file.text();
        if (rows() == 0) return copy(out, text);
        if (is_text()) {
            find_style();
            if (style_.needs_tolerance()) find_tolerances();
        }
        sort();
        copy(out, text.substr(0, offset_of(0)));
        write_rows(out, rows(), mesh_.threads, [&](std::size_t row, TextOut& to) {
            std::size_t at = offset_of(row);
            for_each_slot(row, [&](const CoordinateSlot& slot, std::size_t end) {
                to << text.substr(at, slot.offset - at);
                at = end;
                write_slot(slot, end, to);
            });
            if (row + 1 < rows()) to << text.substr(at, offset_of(row + 1) - at);
        });
        std::size_t rest = 0;
        for_each_slot(rows() - 1, [&](const CoordinateSlot&, std::size_t end) { rest = end; });
        copy(out, text.substr(rest));
    }

private:
    using Complex = std::complex<double>;

    static void copy(std::ostream& out, std::string_view text) {
        out.write(text.data(), static_cast<std::streamsize>(text.size()));
    }
    // A row is a slot, or a point of a file in pairs.
    bool in_pairs() const { return mesh_.in_file.in_pairs && sorted_.empty(); }
    const std::vector<CoordinateSlot>& slots() const {
        return sorted_.empty() ? mesh_.in_file.slots : sorted_;
    }
    std::size_t rows() const { return in_pairs() ? mesh_.point_offset.size() : slots().size(); }
    std::size_t offset_of(std::size_t row) const {
        return in_pairs() ? mesh_.point_offset[row] : slots()[row].offset;
    }
    // Calls visit(slot, end) for the slots of a row; the number of the slot ends before `end`.
    template <class Visit>
    void for_each_slot(std::size_t row, const Visit& visit) const {
        const auto visit_one = [&](const CoordinateSlot& slot) {
            const std::size_t end = slot.offset + number_length(mesh_, slot.offset);
            visit(slot, end);
            return end;
        };
        if (!in_pairs()) {
            visit_one(slots()[row]);
            return;
        }
        const auto point = static_cast<std::int32_t>(row);
        const std::size_t end = visit_one({mesh_.point_offset[row], point, takes_x});
        visit_one({next_number(mesh_, end), point, takes_y});
    }

    void sort() {  // by place in the file
        bool is_sorted = true;
        for (std::size_t row = 1; row < rows() && is_sorted; ++row)
            is_sorted = offset_of(row - 1) <= offset_of(row);
        if (is_sorted) return;
        std::vector<CoordinateSlot> all;
        for (std::size_t row = 0; row < rows(); ++row)
            for_each_slot(row,
                          [&all](const CoordinateSlot& slot, std::size_t) { all.push_back(slot); });
        std::sort(all.begin(), all.end(), [](const CoordinateSlot& a, const CoordinateSlot& b) {
            return a.offset < b.offset;
        });
        sorted_ = std::move(all);
    }

    bool is_text() const { return mesh_.in_file.kind == NumberKind::text; }

    void write_slot(const CoordinateSlot& slot, std::size_t end, TextOut& to) const {
        double value = 0, tolerance = std::numeric_limits<double>::infinity();
        if (!is_changed(slot, value, tolerance)) {
            to << mesh_.file.text().substr(slot.offset, end - slot.offset);
        } else if (is_text()) {
            style_.append(to.text(), value, tolerance);
        } else {
            char number[8];
            store_real(number, value, mesh_.in_file);
            to << std::string_view(number, end - slot.offset);
        }
    }

    // Tells whether the number differs from that of the file, and finds the value and the largest
    // error with which the value may be written.
    bool is_changed(const CoordinateSlot& slot, double& value, double& tolerance) const {
        const auto point = static_cast<std::size_t>(slot.point);
        if (point >= mesh_.x.size())
            return is_changed(slot, mesh_.in_file.between[point - mesh_.x.size()], value,
                              tolerance);
        tolerance = tolerance_of(point);
        if (slot.rule >= 0) {
            const Complex step = after(point) - before(point);
            return grows(slot, step.real(), step.imag(), value);
        }
        const bool is_x = slot.rule == takes_x;
        value = is_x ? x_[point] : y_[point];
        return !same_bits(value, is_x ? mesh_.x[point] : mesh_.y[point]);
    }

    bool is_changed(const CoordinateSlot& slot, const Between& between, double& value,
                    double& tolerance) const {
        bool moved = false;
        Complex mean_before = 0, mean_after = 0;
        for (std::int32_t k = 0; k < between.n_corners; ++k) {
            const auto corner =
                static_cast<std::size_t>(between.corners[static_cast<std::size_t>(k)]);
            moved = moved || before(corner) != after(corner);
            mean_before += before(corner) / double(between.n_corners);
            mean_after += after(corner) / double(between.n_corners);
            tolerance = std::min(tolerance, tolerance_of(corner));
        }
        if (!moved) return false;
        const Complex offset = Complex(between.x, between.y) - mean_before;
        Complex turned = offset;
        if (between.n_corners == 2) {
            const auto a = static_cast<std::size_t>(between.corners[0]),
                       b = static_cast<std::size_t>(between.corners[1]);
            if (before(a) != before(b)) turned *= (after(b) - after(a)) / (before(b) - before(a));
        }
        const Complex step = (mean_after - mean_before) + (turned - offset);
        return grows(slot, step.real(), step.imag(), value);
    }

    bool grows(const CoordinateSlot& slot, double dx, double dy, double& value) const {
        Direction direction = {{1, 0}};
        if (slot.rule == takes_y) direction = {{0, 1}};
        if (slot.rule >= 0)
            direction = mesh_.in_file.directions[static_cast<std::size_t>(slot.rule)];
        const double change = dx * direction.along[0] + dy * direction.along[1];
        if (change == 0) return false;
        value = read_number(mesh_, slot.offset) + change;
        return true;
    }

    Complex before(std::size_t point) const { return {mesh_.x[point], mesh_.y[point]}; }
    Complex after(std::size_t point) const { return {x_[point], y_[point]}; }

    // Returns a thousandth of the shortest edge at the point, before or after the movement.
    double tolerance_of(std::size_t point) const {
        return shortest_.empty() ? std::numeric_limits<double>::infinity()
                                 : std::sqrt(shortest_[point]) / 1000;
    }

    void find_tolerances() {
        shortest_.assign(mesh_.x.size(), std::numeric_limits<double>::infinity());
        for (std::size_t cell = 0; cell + 1 < mesh_.cell_start.size(); ++cell) {
            const auto first = static_cast<std::size_t>(mesh_.cell_start[cell]);
            const auto n = static_cast<std::size_t>(mesh_.cell_start[cell + 1]) - first;
            for (std::size_t i = 0; i < n; ++i) {
                const auto a = static_cast<std::size_t>(mesh_.cell_points[first + i]);
                const auto b =
                    static_cast<std::size_t>(mesh_.cell_points[first + (i + 1 < n ? i + 1 : 0)]);
                const double dx = mesh_.x[a] - mesh_.x[b], dy = mesh_.y[a] - mesh_.y[b];
                const double ex = x_[a] - x_[b], ey = y_[a] - y_[b];
                const double shorter = std::min(dx * dx + dy * dy, ex * ex + ey * ey);
                shortest_[a] = std::min(shortest_[a], shorter);
                shortest_[b] = std::min(shortest_[b], shorter);
            }
        }
    }

    void find_style() {
        std::vector<NumberStyle> styles(static_cast<std::size_t>(mesh_.threads));
        run_ranges(rows(), mesh_.threads, [&](std::size_t begin, std::size_t last, std::size_t k) {
            NumberStyle style;
            for (std::size_t row = begin; row < last; ++row) {
                for_each_slot(row, [&](const CoordinateSlot& slot, std::size_t end) {
                    style.see(mesh_.file.text().substr(slot.offset, end - slot.offset));
                });
            }
            styles[k] = style;
        });
        for (const NumberStyle& style : styles) style_.see(style);
    }

    const Mesh& mesh_;
    const double *x_, *y_;
    std::vector<CoordinateSlot> sorted_;  // by place in the file; empty: the rows are sorted
    std::vector<double> shortest_;        // squares of edges; empty: tolerances are not needed
    NumberStyle style_;
};

}  // namespace

void write_moved(std::ostream& out, const Mesh& mesh, const double* x, const double* y) {
    Rewriter rewriter(mesh, x, y);
    if (!mesh.in_file.store) return rewriter.write(out);
    std::ostringstream numbers;
    rewriter.write(numbers);
    mesh.in_file.store(out, mesh, numbers.str());
}

void round_as_file(const Mesh& mesh, std::vector<double>& x, std::vector<double>& y) {
    if (mesh.in_file.kind != NumberKind::real32 || mesh.in_file.is_computed) return;
    for (double& value : x) value = static_cast<double>(static_cast<float>(value));
    for (double& value : y) value = static_cast<double>(static_cast<float>(value));
}

}  // namespace cli
