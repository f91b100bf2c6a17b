// Functions of the compact scheme by elimination in a dense matrix, independently of the library:
// finite elements on the triangles of all cells.
#pragma once

#include "reference.hpp"

#include <complex>
#include <map>

namespace fuzz {

using Complex = std::complex<double>;
using Values = std::vector<Complex>;
using Table = std::vector<Values>;  // of each function the values at all points of a basis

// std::complex also looks for infinities, which takes most of the time.
template <class Real>
std::complex<Real> product(std::complex<Real> a, std::complex<Real> b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

// The functions of the control points on the mesh, by elimination in a dense matrix: minimisers of
// the integral of k |grad F|^2, or of k |f_x + i f_y|^2, with F linear in each triangle. All is
// computed in numbers of the type Real.
template <class Real>
class DenseSolution {
    using Number = std::complex<Real>;

public:
    DenseSolution(Problem const& problem, Judged const& judged, Table const& on_walls,
                  std::vector<bool> const& is_on_wall)
        : problem_(problem),
          on_walls_(on_walls),
          is_on_wall_(is_on_wall),
          same_(points().size()),
          row_of_(points().size(), -1) {
        Domain const& domain = problem.domain;
        std::size_t const n_points = points().size();
        std::map<std::pair<double, double>, std::size_t> first;  // points at one place are one
        for (std::size_t k = 0; k < n_points; ++k)
            same_[k] = first.try_emplace({points()[k].x, points()[k].y}, k).first->second;
        std::vector<bool> known(n_points, true);
        for (Cell const& cell : domain.cells)
            for (std::int32_t const k : cell) known[same_[at(k)]] = false;
        for (Face const& face : domain.faces)
            known[same_[at(face.from)]] = known[same_[at(face.to)]] = true;
        for (std::size_t k = 0; k < n_points; ++k)
            if (same_[k] == k && !known[k]) row_of_[k] = n_++;
        rows_.assign(at(n_), std::vector<Number>(at(n_) + on_walls.size(), 0));
        find_faces();
        for (auto const& [a, b, c] : judged.triangles) add_cell({a, b, c});
        for (std::size_t number = 0; number < domain.cells.size(); ++number)
            if (!judged.is_divided[number]) add_cell(domain.cells[number]);
        eliminate();
        values.assign(on_walls.size(), Values(n_points, 0));
        for (std::size_t i = 0; i < values.size(); ++i)
            for (std::size_t k = 0; k < n_points; ++k) {
                std::int32_t const row = row_of_[same_[k]];
                if (row >= 0) values[i][k] = Complex(rows_[at(row)][at(n_) + i]);
                else if (is_on_wall[same_[k]]) values[i][k] = on_walls[i][same_[k]];
            }
    }

    Table values;

private:
    std::vector<Point> const& points() const { return problem_.domain.points; }

    // The faces on curves, and their extent.
    void find_faces() {
        Point low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
        for (hm_condition const& condition : problem_.conditions)
            for (Face const& face : problem_.domain.faces) {
                if (face.marker != condition.marker) continue;
                faces_.push_back(face);
                for (std::int32_t const k : {face.from, face.to}) {
                    Point const p = points()[at(k)];
                    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
                    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
                }
            }
        extent_ = std::max(Real(high.x) - low.x, Real(high.y) - low.y);
    }
    // The header: k = 1 / d^q, d by the barycentre of the cell.
    Real weight_of(Cell const& cell) const {
        Options const& options = problem_.options;
        double const usual = options.operator_kind == HM_CONFORMAL ? 1.5 : 1,
                     q = options.exponent == 0 ? usual : options.exponent;
        if (options.operator_kind == HM_LAPLACE || q < 0) return 1;
        Real x = 0, y = 0, least = HUGE_VAL;
        for (std::int32_t const k : cell)
            x += points()[at(k)].x / Real(cell.size()), y += points()[at(k)].y / Real(cell.size());
        for (Face const& face : faces_)
            least = std::min(least, Real(foot_on(points()[at(face.from)], points()[at(face.to)],
                                                 {double(x), double(y)})
                                             .distance));
        return std::pow(least / extent_, -Real(q));
    }
    // A triangle once, a quadrilateral by both its splits.
    void add_cell(Cell const& cell) {
        Real const k = weight_of(cell);
        std::size_t const n = cell.size();
        if (n == 3) return add_triangle(cell, k);
        for (std::size_t c = 0; c < n; ++c)
            add_triangle({cell[(c + n - 1) % n], cell[c], cell[(c + 1) % n]}, k / 2);
    }
    // The energy of a triangle is k A |sum_p g_p f_p|^2, g_p the gradient of the function that is 1
    // at corner p, as a complex number.
    void add_triangle(Cell const& corner, Real k) {
        auto const side = [&](std::size_t from) {  // the one behind the next corner
            Point const a = points()[at(corner[(from + 1) % 3])],
                        b = points()[at(corner[(from + 2) % 3])];
            return Number(Real(b.x) - a.x, Real(b.y) - a.y);
        };
        Real const twice_area = std::imag(product(std::conj(side(0)), side(1)));
        bool const is_conformal = problem_.options.operator_kind == HM_CONFORMAL;
        for (std::size_t p = 0; p < 3; ++p)
            for (std::size_t q = 0; q < 3; ++q) {
                // Gradients are sides turned by 90 degrees over twice the area.
                Number entry = product(std::conj(side(p)), side(q)) * (k / (2 * twice_area));
                if (!is_conformal) entry = std::real(entry);
                std::size_t const to = same_[at(corner[p])], from = same_[at(corner[q])];
                if (row_of_[to] < 0) continue;
                std::vector<Number>& row = rows_[at(row_of_[to])];
                if (row_of_[from] >= 0) row[at(row_of_[from])] += entry;
                for (std::size_t i = 0; i < on_walls_.size() && is_on_wall_[from]; ++i)
                    row[at(n_) + i] -= product(entry, Number(on_walls_[i][from]));
            }
    }
    void eliminate() {
        std::size_t const n = at(n_), width = n + on_walls_.size();
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t pivot = k;
            for (std::size_t r = k; r < n; ++r)
                if (std::norm(rows_[r][k]) > std::norm(rows_[pivot][k])) pivot = r;
            std::swap(rows_[k], rows_[pivot]);
            for (std::size_t r = k + 1; r < n; ++r) {
                if (rows_[r][k] == Number(0)) continue;
                Number const factor = rows_[r][k] / rows_[k][k];
                for (std::size_t c = k; c < width; ++c) rows_[r][c] -= product(factor, rows_[k][c]);
            }
        }
        for (std::size_t k = n; k-- > 0;)
            for (std::size_t i = n; i < width; ++i) {
                for (std::size_t c = k + 1; c < n; ++c)
                    rows_[k][i] -= product(rows_[k][c], rows_[c][i]);
                rows_[k][i] /= rows_[k][k];
            }
    }

    Problem const& problem_;
    Table const& on_walls_;
    std::vector<bool> const& is_on_wall_;
    std::vector<Face> faces_;
    Real extent_ = 1;
    std::vector<std::size_t> same_;
    std::vector<std::int32_t> row_of_;
    std::int32_t n_ = 0;
    std::vector<std::vector<Number>> rows_;
};

}  // namespace fuzz
