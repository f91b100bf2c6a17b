// Writes the file of a mesh, of any format, with other coordinates.
#include "formats/format.hpp"

#include "formats/bytes.hpp"
#include "formats/number_style.hpp"
#include "basics/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <limits>
#include <ostream>
#include <sstream>

namespace cli {

namespace {

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

struct Change {
    std::size_t offset, length;
    double value, tolerance;
};

// All numbers that differ between the file and the moved mesh, in the order of the file.
class Changes {
public:
    Changes(const Mesh& mesh, const double* x, const double* y) : mesh_(mesh), x_(x), y_(y) {
        find_tolerances();
        const auto n = static_cast<std::size_t>(mesh.points());
        for (const CoordinateSlot& slot : mesh.in_file.slots) {
            const auto point = static_cast<std::size_t>(slot.point);
            if (point >= n) {
                move_between(slot, mesh.in_file.between[point - n]);
            } else if (!same_bits(x[point], mesh.x[point]) || !same_bits(y[point], mesh.y[point])) {
                move(slot, point);
            }
        }
        const auto before = [](const Change& a, const Change& b) { return a.offset < b.offset; };
        if (!std::is_sorted(list.begin(), list.end(), before))
            std::sort(list.begin(), list.end(), before);
    }

    std::vector<Change> list;

private:
    using Complex = std::complex<double>;

    void move(const CoordinateSlot& slot, std::size_t point) {
        const double dx = x_[point] - mesh_.x[point], dy = y_[point] - mesh_.y[point];
        if (slot.rule == takes_x) {
            if (!same_bits(x_[point], mesh_.x[point])) add(slot, x_[point], tolerance_[point]);
        } else if (slot.rule == takes_y) {
            if (!same_bits(y_[point], mesh_.y[point])) add(slot, y_[point], tolerance_[point]);
        } else {
            grow(slot, dx, dy, tolerance_[point]);
        }
    }

    void move_between(const CoordinateSlot& slot, const Between& between) {
        bool moved = false;
        double tolerance = std::numeric_limits<double>::infinity();
        Complex mean_before = 0, mean_after = 0;
        for (std::int32_t k = 0; k < between.n_corners; ++k) {
            const auto corner =
                static_cast<std::size_t>(between.corners[static_cast<std::size_t>(k)]);
            moved = moved || before(corner) != after(corner);
            mean_before += before(corner) / double(between.n_corners);
            mean_after += after(corner) / double(between.n_corners);
            tolerance = std::min(tolerance, tolerance_[corner]);
        }
        if (!moved) return;
        const Complex offset = Complex(between.x, between.y) - mean_before;
        Complex turned = offset;
        if (between.n_corners == 2) {
            const auto a = static_cast<std::size_t>(between.corners[0]),
                       b = static_cast<std::size_t>(between.corners[1]);
            if (before(a) != before(b)) turned *= (after(b) - after(a)) / (before(b) - before(a));
        }
        const Complex step = (mean_after - mean_before) + (turned - offset);
        grow(slot, step.real(), step.imag(), tolerance);
    }

    void grow(const CoordinateSlot& slot, double dx, double dy, double tolerance) {
        Direction direction = {{1, 0}};
        if (slot.rule == takes_y) direction = {{0, 1}};
        if (slot.rule >= 0)
            direction = mesh_.in_file.directions[static_cast<std::size_t>(slot.rule)];
        const double change = dx * direction.along[0] + dy * direction.along[1];
        if (change != 0) add(slot, read_number(mesh_, slot.offset) + change, tolerance);
    }

    void add(const CoordinateSlot& slot, double value, double tolerance) {
        list.push_back({slot.offset, number_length(mesh_, slot.offset), value, tolerance});
    }

    Complex before(std::size_t point) const { return {mesh_.x[point], mesh_.y[point]}; }
    Complex after(std::size_t point) const { return {x_[point], y_[point]}; }

    // Finds a thousandth of the shortest edge at each point, before or after the movement.
    void find_tolerances() {
        tolerance_.assign(mesh_.x.size(), std::numeric_limits<double>::infinity());
        for (std::size_t cell = 0; cell + 1 < mesh_.cell_start.size(); ++cell) {
            const auto first = static_cast<std::size_t>(mesh_.cell_start[cell]);
            const auto n = static_cast<std::size_t>(mesh_.cell_start[cell + 1]) - first;
            for (std::size_t i = 0; i < n; ++i) {
                const auto a = static_cast<std::size_t>(mesh_.cell_points[first + i]);
                const auto b =
                    static_cast<std::size_t>(mesh_.cell_points[first + (i + 1 < n ? i + 1 : 0)]);
                const double dx = mesh_.x[a] - mesh_.x[b], dy = mesh_.y[a] - mesh_.y[b];
                const double ex = x_[a] - x_[b], ey = y_[a] - y_[b];
                const double least =
                    std::sqrt(std::min(dx * dx + dy * dy, ex * ex + ey * ey)) / 1000;
                tolerance_[a] = std::min(tolerance_[a], least);
                tolerance_[b] = std::min(tolerance_[b], least);
            }
        }
    }

    const Mesh& mesh_;
    const double *x_, *y_;
    std::vector<double> tolerance_;
};

NumberStyle style_of(const Mesh& mesh) {
    NumberStyle style;
    for (const CoordinateSlot& slot : mesh.in_file.slots) {
        style.see(std::string_view(mesh.file.text())
                      .substr(slot.offset, number_length(mesh, slot.offset)));
    }
    return style;
}

void write_changed(std::ostream& out, const Mesh& mesh, const double* x, const double* y) {
    const std::string& text = mesh.file.text();
    const Changes changes(mesh, x, y);
    const bool is_text = mesh.in_file.kind == NumberKind::text;
    const NumberStyle style = is_text ? style_of(mesh) : NumberStyle();
    std::size_t copied = 0;
    for (const Change& change : changes.list) {
        out.write(text.data() + copied, static_cast<std::streamsize>(change.offset - copied));
        if (is_text) {
            out << style.print(change.value, change.tolerance);
        } else {
            char number[8];
            store_real(number, change.value, mesh.in_file);
            out.write(number, static_cast<std::streamsize>(change.length));
        }
        copied = change.offset + change.length;
    }
    out.write(text.data() + copied, static_cast<std::streamsize>(text.size() - copied));
}

}  // namespace

void write_moved(std::ostream& out, const Mesh& mesh, const double* x, const double* y) {
    if (!mesh.in_file.store) return write_changed(out, mesh, x, y);
    std::ostringstream numbers;
    write_changed(numbers, mesh, x, y);
    mesh.in_file.store(out, mesh, numbers.str());
}

void round_as_file(const Mesh& mesh, std::vector<double>& x, std::vector<double>& y) {
    if (mesh.in_file.kind != NumberKind::real32 || mesh.in_file.is_computed) return;
    for (double& value : x) value = static_cast<double>(static_cast<float>(value));
    for (double& value : y) value = static_cast<double>(static_cast<float>(value));
}

}  // namespace cli
