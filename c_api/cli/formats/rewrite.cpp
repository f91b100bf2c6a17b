// Writes the file of a mesh, of any format, with other coordinates.
#include "files/ordered_output.hpp"
#include "files/tasks.hpp"
#include "formats/bytes.hpp"
#include "formats/format.hpp"
#include "formats/number_style.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <limits>
#include <ostream>
#include <sstream>
#include <utility>

namespace cli {

namespace {

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
