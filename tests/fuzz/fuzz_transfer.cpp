// Functions of a random problem on a mesh that is twice as fine: each cell has a new point on each
// side, and a quadrilateral another one inside. The new points of sides are half way between two
// coarse points, so that the transferred functions have to be half way, too, up to the correction
// of the wall; curve points have the basis functions.
#include <harmorph_bases.h>
#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include "describe.hpp"
#include "reference.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <cmath>
#include <map>

namespace fuzz {
namespace {

// Triangles in four triangles, quadrilaterals in four quadrilaterals. The coarse points come first.
class FineMesh {
public:
    explicit FineMesh(Domain const& coarse) : points_(coarse.points) {
        for (std::size_t k = 0; k < points_.size(); ++k)
            parents_.push_back({static_cast<std::int32_t>(k), static_cast<std::int32_t>(k)});
        for (Cell const& cell : coarse.cells) {
            std::size_t const n = cell.size();
            Cell middle(n);
            for (std::size_t k = 0; k < n; ++k) middle[k] = between(cell[k], cell[(k + 1) % n]);
            std::int32_t const inside = n == 4 ? add({(point(cell[0]).x + point(cell[1]).x +
                                                       point(cell[2]).x + point(cell[3]).x) /
                                                          4,
                                                      (point(cell[0]).y + point(cell[1]).y +
                                                       point(cell[2]).y + point(cell[3]).y) /
                                                          4},
                                                     cell)
                                               : -1;
            for (std::size_t k = 0; k < n; ++k)
                if (n == 4) add_cell({cell[k], middle[k], inside, middle[(k + 3) % 4]});
                else add_cell({cell[k], middle[k], middle[(k + 2) % 3]});
            if (n == 3) add_cell(middle);
        }
        for (Face const& face : coarse.faces) {
            std::int32_t const middle = between(face.from, face.to);
            faces_.insert(faces_.end(), {face.from, middle, middle, face.to});
            markers_.insert(markers_.end(), {face.marker, face.marker});
        }
        for (Point const& p : points_) x_.push_back(p.x), y_.push_back(p.y);
    }

    hm_mesh view() const {
        hm_mesh out = sized<hm_mesh>();
        out.n_points = static_cast<std::int32_t>(points_.size());
        out.points = {x_.data(), y_.data(), 1};
        out.cell_layout = HM_CELLS_ROWS;
        out.n_cells = static_cast<std::int32_t>(start_.size()) - 1;
        out.cell_start = start_.data();
        out.cell_points = corners_.data();
        out.n_faces = static_cast<std::int32_t>(markers_.size());
        out.face_points = faces_.data();
        out.face_markers = markers_.data();
        return out;
    }
    // The coarse points between which a point is: the same one twice, the ends of a side, or the
    // corners of a cell.
    std::vector<Cell> const& parents() const { return parents_; }
    std::vector<std::int32_t> const& faces() const { return faces_; }

private:
    Point point(std::int32_t k) const { return points_[at(k)]; }
    std::int32_t add(Point p, Cell const& parents) {
        points_.push_back(p);
        parents_.push_back(parents);
        return static_cast<std::int32_t>(points_.size()) - 1;
    }
    std::int32_t between(std::int32_t a, std::int32_t b) {
        auto const [found, is_new] = middle_.try_emplace(std::minmax(a, b), 0);
        if (is_new)
            found->second =
                add({(point(a).x + point(b).x) / 2, (point(a).y + point(b).y) / 2}, {a, b});
        return found->second;
    }
    void add_cell(Cell const& cell) {
        corners_.insert(corners_.end(), cell.begin(), cell.end());
        start_.push_back(static_cast<std::int32_t>(corners_.size()));
    }

    std::vector<Point> points_;
    std::vector<Cell> parents_;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middle_;
    std::vector<std::int32_t> corners_, start_{0}, faces_, markers_;
    std::vector<double> x_, y_;
};

class Transferred {
public:
    explicit Transferred(Solution& coarse)
        : coarse_(coarse),
          fine_(coarse.problem.domain),
          mesh_(fine_.view()),
          problem_(coarse.problem.problem) {
        problem_.mesh = &mesh_;
    }

    Outcome run() {
        Options const& options = coarse_.problem.options;
        hm_analysis* analysis = nullptr;
        hm_status status =
            coarse_.blocks.make(error_, size_by(fixtures::analysis_size, &problem_, &options),
                                init_by(hm_analysis_init, &analysis, &problem_, &options));
        if (status < 0)
            return Outcome::refused;  // the curve may leave the finer wall, or rounding invert a
                                      // thin cell
        status = coarse_.blocks.make(error_, size_by(fixtures::basis_size, analysis),
                                     init_by(hm_basis_init, &basis_, analysis));
        expect(status >= 0, "no basis of an analysis");
        std::size_t bytes = 0;
        hm_mesh const& from = coarse_.problem.mesh;
        status = fixtures::transfer_size(analysis, &from, &bytes, &error_);
        expect_told(status, error_);
        expect(status == HM_OK, "no size of a transfer");
        report_.struct_size = sizeof report_;
        Block& work = coarse_.blocks.take(bytes);
        status = hm_transfer(basis_, fixtures::Memory(work.data(), bytes - 1), analysis,
                             coarse_.basis, &from, &report_, &error_);
        expect(status == HM_BLOCK_TOO_SMALL, "work space that is one byte too small is taken");
        expect(report_.points == 0, "a refused call has written its report");
        status = hm_transfer(basis_, fixtures::Memory(work.data(), bytes), analysis, coarse_.basis,
                             &from, &report_, &error_);
        expect_told(status, error_);
        coarse_.blocks.expect_intact();
        if (status < 0) {
            std::vector<double> values(at(mesh_.n_points), 7);
            expect(hm_basis_values(basis_, 0, 0, values.data(), &error_) < 0,
                   "a basis is solved by a refused transfer");
            return Outcome::refused;
        }
        check();
        return Outcome::done;
    }

private:
    using Numbers = std::vector<double>;

    void check() {
        hm_basis_info const info = info_of(basis_);
        expect((report_.outside == 0) == (report_.max_distance_point == -1),
               "points outside, and none that is farthest");
        expect(std::isfinite(report_.max_distance) && report_.max_distance >= 0,
               "a distance that is none");
        expect(std::isfinite(report_.wall_correction), "a correction that is not finite");
        expect(report_.boundary_error <= 1e-11 || info.offset_correction != 0,
               "the wall has other basis functions");
        mark_points(info);
        Numbers coarse(at(coarse_.problem.mesh.n_points)), fine(at(mesh_.n_points));
        for (std::int32_t i = 0; i < info.functions; ++i)
            for (std::int32_t number = 0; number < info.numbers_per_value; ++number) {
                expect(hm_basis_values(coarse_.basis, i, number, coarse.data(), &error_) == HM_OK,
                       "no coarse values");
                expect(hm_basis_values(basis_, i, number, fine.data(), &error_) == HM_OK,
                       "no values");
                between(coarse, fine);
            }
        if (info.offset_correction == 0) on_curves(info);
    }

    // On the boundary conditions decide.
    void mark_points(hm_basis_info const& info) {
        what_.assign(at(mesh_.n_points), What::inside);
        for (std::int32_t const k : fine_.faces()) what_[at(k)] = What::on_boundary;
        for (std::int32_t slot = 0; slot < info.curve_points; ++slot)
            what_[at(info.curve_point[slot])] = What::on_curve;
        // Returns how much the rounding of points changes weights, from the flattest corner and the
        // longest side.
        double area = 1e300, side = 0;
        Judged const judged = judge_by_header(coarse_.problem.domain);
        std::vector<Point> const& points = coarse_.problem.domain.points;
        for (JudgedCorner const& corner : judged.corners) {
            Point const a = points[at(corner.before)], b = points[at(corner.here)],
                        c = points[at(corner.after)];
            area = std::min(area, std::abs((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x)));
            side = std::max(
                {side, std::hypot(b.x - a.x, b.y - a.y), std::hypot(c.x - b.x, c.y - b.y)});
        }
        rounding_ = 1e-12 + 1e-14 * (coarse_.problem.size() / area) * side;
    }

    // Functions of points with two parents are their mean,
    // those of points inside a cell between the least and the largest.
    void between(Numbers const& coarse, Numbers const& fine) const {
        double largest = 0, correction = 0;
        for (double const value : coarse) largest = std::max(largest, std::abs(value));
        auto const mean = [&](Cell const& polygon) {
            return (coarse[at(polygon[0])] + coarse[at(polygon[1])]) / 2;
        };
        for (std::size_t k = 0; k < fine.size(); ++k)
            if (what_[k] == What::on_curve)
                correction = std::max(correction, std::abs(fine[k] - mean(fine_.parents()[k])));
        double const within = correction + rounding_ * largest;
        for (std::size_t k = 0; k < fine.size(); ++k) {
            expect(std::isfinite(fine[k]), "a transferred function is not finite");
            if (what_[k] != What::inside) continue;
            Cell const& from = fine_.parents()[k];
            if (from.size() == 2) {
                expect(std::abs(fine[k] - mean(from)) <= within,
                       "a point half way has a function that is not");
                continue;
            }
            double least = coarse[at(from[0])], most = least;
            for (std::int32_t const p : from)
                least = std::min(least, coarse[at(p)]), most = std::max(most, coarse[at(p)]);
            expect(fine[k] >= least - within && fine[k] <= most + within,
                   "a point inside a cell has a function outside");
        }
    }

    void on_curves(hm_basis_info const& info) {
        Numbers fine(at(mesh_.n_points));
        for (std::int32_t i = 0; i < coarse_.problem.on_walls.view.n_control; ++i) {
            expect(hm_basis_values(basis_, i, 0, fine.data(), &error_) == HM_OK, "no values");
            for (std::int32_t slot = 0; slot < info.curve_points; ++slot) {
                if (info.point_curve[slot] >= info.curves) continue;
                double const expected =
                    basis_functions(coarse_.problem.on_walls.view, info.point_curve[slot],
                                    info.point_u[slot])[at(i)];
                expect(std::abs(fine[at(info.curve_point[slot])] - expected) < 1e-11,
                       "a curve point has another function");
            }
        }
    }

    enum class What { inside, on_boundary, on_curve };

    Solution& coarse_;
    FineMesh fine_;
    hm_mesh mesh_;
    hm_problem problem_;
    hm_basis* basis_ = nullptr;
    hm_transfer_report report_{};
    hm_error error_{};
    std::vector<What> what_;
    double rounding_ = 0;
};

}  // namespace

Outcome run_transfer(Input& input) {
    std::unique_ptr<Problem> const problem = make_problem(input);
    Solution coarse(*problem, input);
    if (coarse.status < 0) return Outcome::refused;
    return told(*problem, [&] { return Transferred(coarse).run(); });
}

}  // namespace fuzz
