// Messages name points of structured blocks by i, j and block, and say where a marker has both
// sides of a cut.
#include <doctest/doctest.h>
#include <harmorph_design.h>

#include <fixtures/memory.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace {

// A C-mesh: `wake` faces behind the body on either side of the cut, and `around` faces around it.
struct CMesh {
    std::int32_t wake, ni, nj, base;
    std::vector<double> x, y;
    std::vector<std::int32_t> lists, start, markers;

    CMesh(std::int32_t wake_faces, std::int32_t around, std::int32_t rows, std::int32_t index_base,
          bool marks_cut)
        : wake(wake_faces), ni(2 * wake_faces + around + 1), nj(rows), base(index_base) {
        const double pi = 3.14159265358979323846;
        for (std::int32_t j = 0; j < nj; ++j) {
            for (std::int32_t i = 0; i < ni; ++i) {
                const std::int32_t back = std::max(wake - i, i - (ni - 1 - wake));
                const double behind = std::max(0, back) / double(wake), s = j / double(nj - 1);
                const double angle =
                    2 * pi * std::min(std::max(i - wake, 0), around) / double(around);
                const double side = i < ni / 2 ? -1 : 1;
                double near_x = .5 * (1 + std::cos(angle)),
                       near_y = -.1 * std::sin(angle) * std::sqrt(1 - near_x);
                double far_x = .5 - 3 * std::sin(angle / 2), far_y = -3 * std::cos(angle / 2);
                if (back >= 0) near_x = 1 + 2 * behind, near_y = 0;
                if (back >= 0) far_x = .5 + 3 * behind, far_y = 3 * side;
                x.push_back(near_x + s * (far_x - near_x));
                y.push_back(near_y + s * (far_y - near_y));
            }
        }
        const std::int32_t first = marks_cut ? 0 : wake, last = marks_cut ? ni - 1 : ni - 1 - wake;
        line(1, first, last, 0, 0);
        line(2, 0, ni - 1, nj - 1, nj - 1);
        line(2, 0, 0, 0, nj - 1);
        line(2, ni - 1, ni - 1, 0, nj - 1);
        start.push_back(std::int32_t(lists.size()) + base);
    }
    void line(std::int32_t marker, std::int32_t i, std::int32_t to_i, std::int32_t j,
              std::int32_t to_j) {
        start.push_back(std::int32_t(lists.size()) + base);
        markers.push_back(marker);
        for (;; i += i < to_i, j += j < to_j) {
            lists.push_back(i + ni * j + base);
            if (i == to_i && j == to_j) return;
        }
    }
    hm_mesh view() const {
        hm_mesh mesh;
        HM_INIT(mesh);
        mesh.index_base = base;
        mesh.n_points = ni * nj;
        mesh.points = {x.data(), y.data(), 1};
        mesh.cell_layout = HM_CELLS_STRUCTURED;
        mesh.ni = ni;
        mesh.nj = nj;
        mesh.n_lists = std::int32_t(markers.size());
        mesh.list_start = start.data();
        mesh.list_points = lists.data();
        mesh.list_markers = markers.data();
        return mesh;
    }
    std::string named(std::int32_t i, std::int32_t j) const {
        return std::to_string(i + ni * j + base) + " (i=" + std::to_string(i + base) +
               ", j=" + std::to_string(j + base) + ")";
    }
};

hm_error fitted(hm_mesh const& mesh) {
    hm_fit_options options;
    HM_INIT(options);
    const std::int32_t marker = 1;
    std::size_t bytes = 0;
    hm_error error{};
    const hm_status status = fixtures::fit_marker_size(&mesh, 1, &marker, &options, &bytes, &error);
    if (status < 0) return error;
    std::vector<unsigned char> block(bytes);
    const hm_curves* curves = nullptr;
    hm_fit_marker(&curves, fixtures::Memory(block.data(), block.size()), &mesh, 1, &marker,
                  &options, nullptr, &error);
    return error;
}

}  // namespace

TEST_CASE("a marker with both sides of a cut is refused, and the ends of the cut are named") {
    for (std::int32_t base : {0, 1}) {
        for (std::int32_t wake : {3, 20}) {
            CMesh const wrong(wake, 60, 9, base, true), right(wake, 60, 9, base, false);
            hm_error const error = fitted(wrong.view());
            INFO(error.text);
            CHECK(error.code == HM_BAD_CONDITION);
            CHECK(std::string(error.text) ==
                  "the marker has both sides of a cut, which meet the body at points " +
                      wrong.named(wake, 0) + " and " + wrong.named(wake + 60, 0) +
                      "; leave the faces of the cut without a marker");
            CHECK(error.item == wake + base);
            CHECK(error.other == wake + 60 + base);
            CHECK(fitted(right.view()).code >= 0);
        }
    }
}

TEST_CASE("a point of a structured mesh is named by i and j, from the index base") {
    for (std::int32_t base : {0, 1}) {
        for (std::int32_t j : {0, 4, 8}) {
            CMesh mesh(5, 30, 9, base, false);
            mesh.y[std::size_t(7 + mesh.ni * j)] = std::numeric_limits<double>::quiet_NaN();
            hm_error const error = fitted(mesh.view());
            CHECK(std::string(error.text).find("point " + mesh.named(7, j)) == 0);
            CHECK(error.item == 7 + mesh.ni * j + base);
        }
    }
}

TEST_CASE("a point of several blocks is named by its block, too; unstructured points are not") {
    // Two blocks beside each other, of 4 x 3 and 3 x 3 points.
    std::vector<double> x, y;
    for (std::int32_t block : {0, 1})
        for (std::int32_t j = 0; j < 3; ++j)
            for (std::int32_t i = 0; i < 4 - block; ++i) x.push_back(3 * block + i), y.push_back(j);
    const std::int32_t sizes[] = {4, 3, 3, 3};
    const std::int32_t sides[] = {1, HM_NO_MARKER, 1, 1, HM_NO_MARKER, 1, 1, 1};
    hm_mesh mesh;
    HM_INIT(mesh);
    mesh.n_points = std::int32_t(x.size());
    mesh.points = {x.data(), y.data(), 1};
    mesh.cell_layout = HM_CELLS_BLOCKS;
    mesh.n_blocks = 2;
    mesh.block_sizes = sizes;
    mesh.block_markers = sides;
    for (std::int32_t base : {0, 1}) {
        mesh.index_base = base;
        struct {
            std::size_t point;
            std::int32_t i, j, block;
        } const cases[] = {{0, 0, 0, 0}, {11, 3, 2, 0}, {12, 0, 0, 1}, {17, 2, 1, 1}};
        for (auto const& one : cases) {
            const double kept = x[one.point];
            x[one.point] = std::numeric_limits<double>::infinity();
            const std::string text = fitted(mesh).text;
            CHECK(text.find("point " + std::to_string(std::int32_t(one.point) + base) + " (i=" +
                            std::to_string(one.i + base) + ", j=" + std::to_string(one.j + base) +
                            " of block " + std::to_string(one.block + base) + ")") == 0);
            x[one.point] = kept;
        }
    }
    const std::int32_t cells[] = {0, 1, 5, 4}, faces[] = {0, 1, 1, 5, 5, 4, 4, 0},
                       markers[] = {1, 1, 1, 1};
    hm_mesh one;
    HM_INIT(one);
    one.n_points = 12;
    one.points = mesh.points;
    one.cell_layout = HM_CELLS_QUADS;
    one.n_cells = 1;
    one.cell_points = cells;
    one.n_faces = 4;
    one.face_points = faces;
    one.face_markers = markers;
    x[5] = std::numeric_limits<double>::quiet_NaN();
    CHECK(std::string(fitted(one).text).find("point 5 has") == 0);
}
