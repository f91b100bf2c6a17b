// Interpolated fields against a search over all cells and faces.
#include "fields_model.hpp"

#include <map>
#include <fixtures/memory.hpp>

namespace fuzz {

void FieldsModel::interpolation() {
    std::vector<Point> const places = this->places();
    std::size_t const n = places.size();
    bool const is_bad = has_bad(places);
    std::int32_t const count = static_cast<std::int32_t>(n);
    hm_points const to = in(places);
    Numbers distance(n, 7);
    hm_interpolation* interpolation = nullptr;
    hm_interpolation_report report = sized<hm_interpolation_report>();
    std::size_t bytes = 0;
    expect(fixtures::interpolation_size(analysis_, -1, &bytes, &error_) < 0, "-1 points are taken");
    hm_status const status =
        blocks_.make(error_, size_by(fixtures::interpolation_size, analysis_, count),
                     init_by(hm_interpolation_init, &interpolation, analysis_, nullptr, count, &to,
                             distance.data(), problem_.options.executor, &report));
    if (status < 0) {
        expect_untouched(distance);
        bool const is_valid = inverted_cells(judged_, points_, 1e-12) == 0;
        expect(is_bad || !is_valid || judged_.ambiguous > 0,
               std::string("an interpolation is refused: ") + error_.text);
        return;
    }
    expect(!is_bad, "a point is taken that does not exist");
    std::int32_t outside = 0;
    for (double const number : distance) outside += number > 0 ? 1 : 0;
    expect(report.outside == outside, "another number of points is outside than have a distance");
    interpolated(interpolation, places, distance);
    transpose(interpolation, n);
}

// A place that rounding puts beside its thin cell must not be taken by the large cell next to it:
// cells that contain the place come first, and then those that nearly do.
bool FieldsModel::value_in_mesh(Point place, Numbers const& field, Wide& value,
                                Wide& rounding) const {
    return value_in_cells(place, field, 0, value, rounding) ||
           value_in_cells(place, field, 1e-9L, value, rounding);
}

bool FieldsModel::value_in_cells(Point place, Numbers const& field, Wide beside, Wide& value,
                                 Wide& rounding) const {
    std::vector<std::pair<std::array<std::int32_t, 3>, bool>> triangles;  // is one of two divisions
    Wide sum = 0;
    int found = 0, wanted = 1;
    auto const search = [&](std::array<std::int32_t, 3> const& k) {
        Point const a = points_[at(k[0])], b = points_[at(k[1])], c = points_[at(k[2])];
        auto const area = [](Point p, Point q, Point r) {
            return (Wide(q.x) - p.x) * (Wide(r.y) - p.y) - (Wide(q.y) - p.y) * (Wide(r.x) - p.x);
        };
        Wide const whole = area(a, b, c), u = area(place, b, c) / whole,
                   v = area(place, c, a) / whole, w = area(place, a, b) / whole;
        if (!(u >= -beside && v >= -beside && w >= -beside)) return false;
        sum += u * field[at(k[0])] + v * field[at(k[1])] + w * field[at(k[2])];
        Wide const side = std::max({std::hypot(Wide(b.x) - a.x, Wide(b.y) - a.y),
                                    std::hypot(Wide(c.x) - b.x, Wide(c.y) - b.y),
                                    std::hypot(Wide(a.x) - c.x, Wide(a.y) - c.y)});
        rounding = std::max(rounding, 1e-8L + 64 * 0x1p-53L * side * side / std::abs(whole));
        return true;
    };
    rounding = 0;
    for (auto const& triangle : judged_.triangles)
        if (search(triangle)) return value = sum, true;
    for (std::size_t c = 0; c < problem_.domain.cells.size(); ++c) {
        if (judged_.is_divided[c]) continue;
        Cell const& cell = problem_.domain.cells[c];
        sum = 0, found = 0, wanted = cell.size() == 3 ? 1 : 2;
        if (wanted == 1) found = search({cell[0], cell[1], cell[2]}) ? 1 : 0;
        else {
            found += search({cell[0], cell[1], cell[2]}) || search({cell[0], cell[2], cell[3]});
            found += search({cell[0], cell[1], cell[3]}) || search({cell[1], cell[2], cell[3]});
        }
        if (found == wanted) return value = sum / wanted, true;
    }
    return false;
}

void FieldsModel::interpolated(hm_interpolation const* interpolation,
                               std::vector<Point> const& places, Numbers const& distance) {
    std::size_t const n = places.size(), n_points = points_.size();
    Numbers fields(2 * n_points), values(2 * n, 7);
    std::map<std::pair<double, double>, double> at_place;  // both sides of a cut have one value
    for (std::size_t k = 0; k < n_points; ++k) {
        fields[k] =
            at_place.try_emplace({points_[k].x, points_[k].y}, input_.between(-1, 1)).first->second;
        fields[n_points + k] =
            (points_[k].x - points_[0].x) / extent_ + 2 * ((points_[k].y - points_[0].y) / extent_);
    }
    done(hm_interpolate(interpolation, 2, fields.data(), values.data(), problem_.options.executor,
                        &error_),
         "interpolated fields");
    for (std::size_t k = 0; k < n; ++k)
        expect(std::abs(values[k]) <= 1 + 1e-5, "a value beyond those of the corners of its cell");
    if (has_short_sides()) return;
    for (std::size_t k = 0; k < n; ++k) {
        Wide least = HUGE_VALL, on_boundary = 0, value = 0, rounding = 0;
        int equal = 0;
        for (Face const& face : problem_.domain.faces) {
            Foot const foot = foot_on(points_[at(face.from)], points_[at(face.to)], places[k]);
            bool const is_close = std::abs(foot.distance - least) <= 1e-9L * extent_;
            if (foot.distance < least) {
                least = foot.distance;
                on_boundary = (1 - foot.t) * fields[at(face.from)] + foot.t * fields[at(face.to)];
            }
            equal = is_close ? equal + 1 : foot.distance == least ? 1 : equal;
        }
        bool const is_inside = value_in_mesh(places[k], fields, value, rounding);
        // In a cell whose sides differ by many powers of ten, rounding decides about a place.
        if (judged_.ambiguous > 0 || rounding > 2e-8L) continue;
        if (is_inside) {
            expect(distance[k] <= 1e-7 * extent_, "a point of the mesh is said to be outside");
        } else {
            expect(std::abs(distance[k] - least) <= 1e-12L * least + 1e-9L * extent_,
                   "the distance of a point outside differs from the reference");
            value = on_boundary;
            rounding = 1e-7L;
            if (equal > 1 || least > 1e2L * extent_) continue;  // rounding decides where
        }
        if (rounding > 0.1L || least < 1e-9L * extent_) continue;
        expect(std::abs(values[k] - value) <= rounding * 4,
               "an interpolated value differs from the reference by " +
                   std::to_string(double(values[k] - value)));
        if (!is_inside) continue;
        Wide const linear = (Wide(places[k].x) - points_[0].x) / extent_ +
                            2 * ((Wide(places[k].y) - points_[0].y) / extent_);
        Wide const of_origin = 0x1p-48L * size_ / extent_;
        expect(std::abs(values[n + k] - linear) <= 1e-11L + of_origin,
               "a linear field is not interpolated exactly, but with an error of " +
                   std::to_string(double(values[n + k] - linear) * 1e12) + "e-12");
    }
}

void FieldsModel::transpose(hm_interpolation const* interpolation, std::size_t n) {
    std::size_t const n_points = points_.size();
    Numbers from(3 * n_points), to(3 * n, 7), to_dj(3 * n), from_dj(3 * n_points, 5);
    for (double& number : from) number = input_.between(-1, 1);
    for (double& number : to_dj) number = input_.between(-1, 1);
    done(hm_interpolate(interpolation, 3, from.data(), to.data(), nullptr, &error_), "fields");
    done(hm_interpolate_adjoint(interpolation, 3, to_dj.data(), from_dj.data(), &error_),
         "derivatives by fields");
    Wide left = 0, right = 0;
    for (std::size_t k = 0; k < 3 * n; ++k) left += Wide(to[k]) * to_dj[k];
    for (std::size_t k = 0; k < 3 * n_points; ++k) right += Wide(from[k]) * (from_dj[k] - 5);
    expect(std::abs(left - right) <= 1e-13L * Wide(n_points + n),
           "the adjoint of an interpolation is not the transpose");
}

}  // namespace fuzz
