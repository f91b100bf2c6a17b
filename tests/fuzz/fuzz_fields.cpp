// The calls of harmorph_fields.h with random meshes: swept areas, distances to the walls, and
// interpolation. Results are compared with sums and searches over all cells and faces in more
// digits, derivatives with their transposes.
#include "fields_model.hpp"
#include <fixtures/memory.hpp>

namespace fuzz {

FieldsModel::FieldsModel(Problem& problem, Input& input)
    : problem_(problem),
      input_(input),
      judged_(judge_by_header(problem.domain)),
      points_(problem.domain.points),
      size_(problem.size()),
      blocks_(input) {
    Point low = points_[0], high = points_[0];
    for (Point const& p : points_) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    extent_ = std::max(high.x - low.x, high.y - low.y);
    if (input_.one_in(2)) {
        problem_.problem.n_conditions = 0;
        problem_.problem.curves = nullptr;
    }
}

Outcome FieldsModel::run() {
    hm_status const status =
        blocks_.make(error_, size_by(fixtures::analysis_size, &problem_.problem, &problem_.options),
                     init_by(hm_analysis_init, &analysis_, &problem_.problem, &problem_.options));
    if (status < 0) return Outcome::refused;
    for (std::int32_t k = input_.from(1, 4); k > 0; --k) {
        switch (input_.below(3)) {
            case 0: areas(); break;
            case 1: walls(); break;
            default: interpolation();
        }
    }
    blocks_.expect_intact();
    return Outcome::done;
}

std::vector<Point> FieldsModel::displaced() {
    double const by = extent_ * input_.any_of({0.0, 1e-9, 1e-3, 0.1});
    std::vector<Point> out = points_;
    for (Point& p : out) p = {p.x + by * input_.between(-1, 1), p.y + by * input_.between(-1, 1)};
    return has_bad(out) ? points_ : out;
}

std::vector<Point> FieldsModel::places() {
    std::vector<Point> out(input_.below(12) + 1);
    auto const some = [&] {
        return points_[input_.below(static_cast<std::uint32_t>(points_.size()))];
    };
    for (Point& place : out) {
        Point const a = some(), b = some();
        double const t = input_.any_of({0.0, 0.5, 0.25, 1.0 / 3});
        place = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
        if (input_.one_in(2)) continue;
        double const far = extent_ * input_.any_of({1e-12, 0.01, 0.3, 1e3});
        place.x += far * input_.between(-1, 1);
        place.y += far * input_.between(-1, 1);
    }
    if (input_.one_in(12))
        out.back().x = input_.any_of({double(NAN), HUGE_VAL, -HUGE_VAL, 1.01e100});
    return out;
}

Outcome run_fields(Input& input) {
    std::unique_ptr<Problem> const problem =
        make_problem(input, input.one_in(3) ? Cells::polygons : Cells::triangles_and_quads);
    return FieldsModel(*problem, input).run();
}

}  // namespace fuzz
