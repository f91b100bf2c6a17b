#include <harmorph_design.h>
#include <harmorph_study.h>
#include "laplacian.hpp"

#include <algorithm>

namespace bench {
namespace {

using fixtures::Mesh;
using fixtures::Point;

struct Weight {
    Index a, b;
    double value;
};

// Half the cotangent of the angle at each corner belongs to the side it sees.
void add_triangle(Mesh const& mesh, Index const (&corner)[3], double share,
                  std::vector<Weight>& weights) {
    for (int k = 0; k < 3; ++k) {
        Index const a = corner[(k + 1) % 3], b = corner[(k + 2) % 3];
        Point const o = mesh.point(corner[k]), p = mesh.point(a), q = mesh.point(b);
        double const px = p.x - o.x, py = p.y - o.y, qx = q.x - o.x, qy = q.y - o.y;
        double const cotangent = (px * qx + py * qy) / (px * qy - py * qx);
        weights.push_back({a, b, 0.5 * share * cotangent});
    }
}

void add_cell(Mesh const& mesh, Index const* p, Index n, std::vector<Weight>& weights) {
    if (n == 3) return add_triangle(mesh, {p[0], p[1], p[2]}, 1, weights);
    add_triangle(mesh, {p[0], p[1], p[2]}, 0.5, weights);
    add_triangle(mesh, {p[0], p[2], p[3]}, 0.5, weights);
    add_triangle(mesh, {p[0], p[1], p[3]}, 0.5, weights);
    add_triangle(mesh, {p[1], p[2], p[3]}, 0.5, weights);
}

// Entries of one row in columns increasing, equal columns added up. Returns how many are left.
Index compress(Index* column, double* value, Index count) {
    for (Index k = 1; k < count; ++k) {
        for (Index j = k; j > 0 && column[j - 1] > column[j]; --j) {
            std::swap(column[j - 1], column[j]);
            std::swap(value[j - 1], value[j]);
        }
    }
    Index kept = 0;
    for (Index k = 0; k < count; ++k) {
        if (kept > 0 && column[kept - 1] == column[k]) {
            value[kept - 1] += value[k];
        } else {
            column[kept] = column[k];
            value[kept++] = value[k];
        }
    }
    return kept;
}

}  // namespace

Laplacian::Laplacian(Mesh const& mesh) : unknown_of(mesh.x.size(), 0) {
    std::vector<char> on_body(mesh.x.size(), 0);
    for (std::size_t face = 0; face < mesh.face_markers.size(); ++face) {
        for (std::size_t end = 0; end < 2; ++end) {
            std::size_t const point = at(mesh.faces[2 * face + end]);
            unknown_of[point] = -1;
            on_body[point] = mesh.face_markers[face] == fixtures::body;
        }
    }
    for (Index point = 0; point < mesh.n_points(); ++point) {
        if (unknown_of[at(point)] < 0) continue;
        unknown_of[at(point)] = n++;
        point_of.push_back(point);
    }

    std::vector<Weight> weights;
    weights.reserve(3 * mesh.cells.size());  // three a corner of a quad
    for (Index cell = 0; cell < mesh.n_cells(); ++cell) {
        Index const begin = mesh.cell_start[at(cell)];
        add_cell(mesh, mesh.cells.data() + begin, mesh.cell_start[at(cell) + 1] - begin, weights);
    }
    std::vector<double> diagonal(at(n), 0);
    std::vector<std::size_t> filled(at(n) + 1, 1);  // the diagonal
    for (Weight& w : weights) {
        Index const a = unknown_of[at(w.a)], b = unknown_of[at(w.b)];
        if (a >= 0) diagonal[at(a)] += w.value;
        if (b >= 0) diagonal[at(b)] += w.value;
        if (a >= 0 && b < 0 && on_body[at(w.b)]) couplings.push_back({a, w.b, -w.value});
        if (b >= 0 && a < 0 && on_body[at(w.a)]) couplings.push_back({b, w.a, -w.value});
        w = {std::max(a, b), std::min(a, b), -w.value};
        if (w.b >= 0) ++filled[at(w.a)];
    }
    std::size_t sum = 0;
    for (std::size_t& entries : filled) {
        std::size_t const begin = sum;
        sum += entries;
        entries = begin;
    }
    std::vector<std::size_t> const begin = filled;
    column.resize(sum);
    value.resize(sum);
    auto put = [&](Index row, Index to_column, double entry) {
        std::size_t const place = filled[at(row)]++;
        column[place] = to_column;
        value[place] = entry;
    };
    for (Weight const& w : weights)
        if (w.b >= 0) put(w.a, w.b, w.value);
    std::vector<Weight>().swap(weights);  // the largest array of all
    start.push_back(0);
    for (Index row = 0; row < n; ++row) {
        put(row, row, diagonal[at(row)]);
        std::size_t const from = begin[at(row)];
        Index const kept =
            compress(&column[from], &value[from], static_cast<Index>(filled[at(row)] - from));
        std::copy_n(column.data() + from, kept, column.data() + start.back());
        std::copy_n(value.data() + from, kept, value.data() + start.back());
        start.push_back(start.back() + kept);
    }
    column.resize(at(start.back()));
    value.resize(at(start.back()));
}

Columns Laplacian::right_hand_sides(hm_basis const* basis, hm_curves const& curves,
                                    Index n_points) const {
    hm_error error{};
    hm_basis_info info{};
    info.struct_size = sizeof info;
    require(hm_basis_info_get(basis, &info, &error), error, "hm_basis_info_get");
    std::vector<Index> place(at(n_points), -1);
    for (Index k = 0; k < info.curve_points; ++k) place[at(info.curve_point[k])] = k;

    Columns b{at(n), std::vector<double>(at(n) * at(info.functions), 0.0)};
    for (Coupling const& c : couplings) {
        Index const k = place[at(c.point)];
        Index control[6];
        double values[6];
        hm_status const status = hm_curve_basis(&curves, info.point_curve[k], info.point_u[k], 0,
                                                control, values, &error);
        require(status, error, "hm_curve_basis");
        for (Index i = 0; i <= curves.curve[info.point_curve[k]].degree; ++i)
            b[at(control[i] - curves.index_base)][c.unknown] -= c.value * values[i];
    }
    return b;
}

double Laplacian::worst_residual(Columns const& b, Columns const& x) const {
    double worst = 0;
    for (std::size_t k = 0; k < b.count(); ++k) {
        std::vector<double> rest(b[k], b[k] + b.rows);
        double const* const f = x[k];
        for (Index i = 0; i < n; ++i) {
            for (Index e = start[at(i)]; e < start[at(i) + 1]; ++e) {
                Index const j = column[at(e)];
                rest[at(i)] -= value[at(e)] * f[j];
                if (j != i) rest[at(j)] -= value[at(e)] * f[i];
            }
        }
        double whole = 0, left = 0;
        for (std::size_t i = 0; i < b.rows; ++i) {
            whole += b[k][i] * b[k][i];
            left += rest[i] * rest[i];
        }
        double const relative = std::sqrt(left / whole);
        if (!(relative <= worst)) worst = relative;  // NaN stays
    }
    return worst;
}

Columns Laplacian::values_of(hm_basis const* basis, Index functions, Index n_points) const {
    Columns out{at(n), std::vector<double>(at(n) * at(functions))};
    std::vector<double> values(at(n_points));
    hm_error error{};
    for (Index k = 0; k < functions; ++k) {
        require(hm_basis_values(basis, k, 0, values.data(), &error), error, "hm_basis_values");
        for (Index i = 0; i < n; ++i) out[at(k)][i] = values[at(point_of[at(i)])];
    }
    return out;
}

}  // namespace bench
