// A mesh cut into parts: equations of the parts, solved here by elimination, against the functions
// of the whole mesh.
#include "work_in_parts.hpp"

#include "private.h"
#include <harmorph_study.h>

#include <cmath>
#include <map>

namespace fuzz {
namespace {

using Numbers = std::vector<double>;

// Own cells of a part, with points of its own numbering.
struct Part {
    std::vector<std::int32_t> point, start{0}, corners, faces, markers;  // point: in the whole mesh
    std::vector<std::int64_t> numbers;
    Numbers x, y;
    hm_mesh mesh{};
    hm_private_part* part = nullptr;
    hm_private_equations* equations = nullptr;
    hm_basis* rows = nullptr;
    hm_private_equations_info info{};
};

class CutMesh {
public:
    CutMesh(Solution& whole, Input& input)
        : its_(whole), input_(input), domain_(whole.problem.domain) {
        n_parts_ = input_.from(1, 3);
        cut();
    }

    void all() {
        if (!join()) return;
        number_unknowns();
        solve();
        compare();
        its_.blocks.expect_intact();
    }

private:
    // The points of a cell stay in the order of the arrays of the mesh, because the division of a
    // polygon depends on this order.
    Cell given_cell(std::size_t c) const {
        if (!domain_.has_polygons) return domain_.cells[c];
        std::int32_t const base = its_.problem.mesh.index_base;
        std::vector<std::int32_t> const &start = its_.problem.cell_start, &all = its_.problem.cells;
        Cell out(all.begin() + (start[c] - base), all.begin() + (start[c + 1] - base));
        for (std::int32_t& k : out) k -= base;
        return out;
    }

    void cut() {
        parts_.resize(at(n_parts_));
        std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> owner;
        std::vector<std::map<std::int32_t, std::int32_t>> local(parts_.size());
        auto const point_of = [&](std::size_t p, std::int32_t k) {
            auto const [found, is_new] =
                local[p].insert({k, static_cast<std::int32_t>(parts_[p].point.size())});
            if (is_new) {
                parts_[p].point.push_back(k);
                parts_[p].numbers.push_back(3 * std::int64_t{k} + 5);
                parts_[p].x.push_back(domain_.points[at(k)].x);
                parts_[p].y.push_back(domain_.points[at(k)].y);
            }
            return found->second;
        };
        for (std::size_t c = 0; c < domain_.cells.size(); ++c) {
            Cell const cell = given_cell(c);
            std::size_t const p =
                c < parts_.size() ? c : input_.below(static_cast<std::uint32_t>(n_parts_));
            for (std::size_t k = 0; k < cell.size(); ++k) {
                owner[std::minmax(cell[k], cell[(k + 1) % cell.size()])] = p;
                parts_[p].corners.push_back(point_of(p, cell[k]));
            }
            parts_[p].start.push_back(static_cast<std::int32_t>(parts_[p].corners.size()));
        }
        for (Face const& face : domain_.faces) {
            std::size_t const p = owner[std::minmax(face.from, face.to)];
            parts_[p].faces.push_back(point_of(p, face.from));
            parts_[p].faces.push_back(point_of(p, face.to));
            parts_[p].markers.push_back(face.marker);
        }
    }

    // Parts, edges, equations; false if something is refused, as parts have fewer options.
    bool join() {
        std::vector<hm_private_edge> edges;
        for (Part& part : parts_) {
            if (part.start.size() < 2) return false;
            part.mesh.struct_size = sizeof part.mesh;
            part.mesh.n_points = static_cast<std::int32_t>(part.x.size());
            part.mesh.points = {part.x.data(), part.y.data(), 1};
            part.mesh.cell_layout = domain_.has_polygons ? HM_CELLS_POLYGONS : HM_CELLS_ROWS;
            part.mesh.n_cells = static_cast<std::int32_t>(part.start.size()) - 1;
            part.mesh.cell_start = part.start.data();
            part.mesh.cell_points = part.corners.data();
            part.mesh.n_faces = static_cast<std::int32_t>(part.markers.size());
            part.mesh.face_points = part.faces.data();
            part.mesh.face_markers = part.markers.data();
            hm_private_part_mesh part_mesh{};
            part_mesh.struct_size = sizeof part_mesh;
            part_mesh.mesh = &part.mesh;
            part_mesh.numbers = part.numbers.data();
            hm_status const status =
                its_.blocks.make(error_, size_by(hm_private_part_size, &part_mesh),
                                 init_by(hm_private_part_init, &part.part, &part_mesh));
            expect(status == HM_OK,
                   "a part is refused of a mesh that is taken: " + std::string(error_.text));
            std::int32_t n = 0;
            hm_private_part_edges(part.part, nullptr, 0, &n, &error_);
            edges.resize(edges.size() + at(n));
            expect(hm_private_part_edges(part.part, edges.data() + edges.size() - at(n), n, &n,
                                         &error_) == HM_OK,
                   "no edges");
        }
        std::int64_t n = static_cast<std::int64_t>(edges.size());
        expect(hm_private_match_edges(edges.data(), &n, &error_) == HM_OK,
               "parts do not match: " + std::string(error_.text));
        edges.resize(at(n));
        for (Part& part : parts_) {
            std::int32_t const n_edges = static_cast<std::int32_t>(edges.size());
            const hm_problem* const problem = &its_.problem.problem;
            const hm_options* const options = &its_.problem.options;
            hm_status const status = its_.blocks.make(
                error_, size_by(hm_private_equations_size, part.part, n_edges, problem, options),
                init_by(hm_private_equations_init, &part.equations, part.part, n_edges,
                        edges.data(), problem, options));
            if (status == HM_UNSUPPORTED) return false;
            expect(status >= 0, "equations are refused: " + std::string(error_.text));
            part.info.struct_size = sizeof part.info;
            expect(hm_private_equations_info_get(part.equations, &part.info, &error_) == HM_OK,
                   "no equations");
            hm_status const rows =
                its_.blocks.make(error_, size_by(hm_private_rows_size, part.equations),
                                 init_by(hm_private_rows_init, &part.rows, part.equations));
            expect(rows == HM_OK, "no rows: " + std::string(error_.text));
        }
        return true;
    }

    void number_unknowns() {
        for (Part const& part : parts_)
            for (std::int32_t k = 0; k < part.info.unknowns; ++k)
                place_.insert({part.info.unknown[k], 0});
        std::size_t k = 0;
        for (auto& each : place_) each.second = k++;
        size_ = place_.size() * at(parts_[0].info.numbers);
    }
    std::size_t place(Part const& part, std::int32_t unknown, std::int32_t number) const {
        return place_.at(part.info.unknown[unknown]) * at(part.info.numbers) + at(number);
    }
    template <class Take>
    void for_each_number(Part const& part, Take const& take) const {
        std::size_t k = 0;
        for (std::int32_t unknown = 0; unknown < part.info.unknowns; ++unknown)
            for (std::int32_t p = 0; p < part.info.numbers; ++p) take(place(part, unknown, p), k++);
    }

    // A = L L^T of the sum of all parts' entries, columns by substitution, each refined until next
    // to nothing changes. The first correction is what rounding makes of a solution. Where that is
    // more than is allowed for, cells are too thin for this elimination, and nothing is compared.
    void solve() {
        std::vector<Numbers> a(size_, Numbers(size_, 0));
        for (Part const& part : parts_) {
            std::int64_t n = 0;
            hm_private_equations_entries(part.equations, 0, part.info.unknowns, nullptr, nullptr,
                                         nullptr, 0, &n, &error_);
            std::size_t const square = at(part.info.numbers * part.info.numbers);
            std::vector<std::int32_t> row(at(n) + 1), column = row;
            Numbers values(row.size() * square);
            expect(
                hm_private_equations_entries(part.equations, 0, part.info.unknowns, row.data(),
                                             column.data(), values.data(), n, &n, &error_) == HM_OK,
                "no entries");
            for (std::size_t e = 0; e < at(n); ++e)
                for (std::int32_t p = 0; p < part.info.numbers; ++p)
                    for (std::int32_t q = 0; q < part.info.numbers; ++q) {
                        double const value = values[e * square + at(p * part.info.numbers + q)];
                        std::size_t const i = place(part, row[e], p), j = place(part, column[e], q);
                        a[i][j] += value;
                        if (row[e] != column[e]) a[j][i] += value;
                    }
        }
        for (std::size_t i = 0; i < size_; ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
                if (i == j) is_accurate_ = is_accurate_ && a[i][i] > 0;
                a[i][j] = i == j ? std::sqrt(std::max(a[i][i], 1e-300)) : a[i][j] / a[j][j];
            }
        for (std::int32_t column = 0; column < parts_[0].info.columns; ++column) {
            Numbers x(size_, 0);
            for (int step = 0; step < 4; ++step) {
                Numbers b(size_, 0);
                for (Part& part : parts_) {
                    Numbers own(at(part.info.unknowns * part.info.numbers) + 1);
                    hm_status const status =
                        step == 0 ? hm_private_rows_get(part.equations, part.rows, column,
                                                        own.data(), &error_)
                                  : hm_private_rows_residual(part.equations, part.rows, column,
                                                             own.data(), &error_);
                    expect(status == HM_OK, "no right-hand side");
                    for_each_number(part,
                                    [&](std::size_t to, std::size_t from) { b[to] += own[from]; });
                }
                for (std::size_t i = 0; i < size_; ++i) {
                    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
                    b[i] /= a[i][i];
                }
                for (std::size_t i = size_; i-- > 0;) {
                    for (std::size_t k = i + 1; k < size_; ++k) b[i] -= a[k][i] * b[k];
                    b[i] /= a[i][i];
                }
                double largest = 0, change = 0;
                for (std::size_t i = 0; i < size_; ++i) {
                    x[i] += b[i];
                    largest = std::max(largest, std::abs(x[i]));
                    change = std::max(change, std::abs(b[i]));
                }
                if (step == 1) is_accurate_ = is_accurate_ && change <= 1e-6 * largest;
                if (step == 3) is_accurate_ = is_accurate_ && change <= 1e-10 * largest;
                for (Part& part : parts_) {
                    Numbers own(at(part.info.unknowns * part.info.numbers) + 1);
                    for_each_number(part,
                                    [&](std::size_t from, std::size_t to) { own[to] = x[from]; });
                    expect(hm_private_rows_set(part.equations, part.rows, column, own.data(),
                                               &error_) == HM_OK,
                           "not set");
                }
            }
        }
        for (Part& part : parts_)
            expect(hm_private_rows_finish(part.equations, part.rows, 0, &error_) == HM_OK,
                   "not finished");
    }

    void compare() {
        if (its_.status != HM_OK || !is_accurate_) return;
        hm_basis_info const info = info_of(its_.basis);
        Numbers whole(domain_.points.size());
        for (std::int32_t i = 0; i < info.functions; ++i)
            for (std::int32_t number = 0; number < info.numbers_per_value; ++number) {
                expect(hm_basis_values(its_.basis, i, number, whole.data(), &error_) == HM_OK,
                       "no values");
                double largest = 1;
                for (double const value : whole) largest = std::max(largest, std::abs(value));
                for (Part& part : parts_) {
                    Numbers own(part.x.size());
                    expect(hm_basis_values(part.rows, i, number, own.data(), &error_) == HM_OK,
                           "no values of a part");
                    for (std::size_t k = 0; k < own.size(); ++k) {
                        double const off = std::abs(own[k] - whole[at(part.point[k])]) / largest;
                        expect(off <= 1e-6, "a part has another function: off by " +
                                                std::to_string(off * 1e9) + "e-9");
                    }
                }
            }
    }

    Solution& its_;
    Input& input_;
    Domain const& domain_;
    std::int32_t n_parts_ = 1;
    std::vector<Part> parts_;
    std::map<std::int64_t, std::size_t> place_;
    std::size_t size_ = 0;
    bool is_accurate_ = true;
    hm_error error_{};
};

}  // namespace

void check_cut_mesh(Solution& whole, Input& input) { CutMesh(whole, input).all(); }

}  // namespace fuzz
