#include "mesh/refine.hpp"

#include "basics/numbers.hpp"
#include "mesh/loops.hpp"

#include <algorithm>
#include <ostream>

namespace cli {

namespace {

class Refined {
public:
    explicit Refined(const Mesh& mesh)
        : mesh_(mesh), edges_(mesh_edges(mesh, [](Edge) { return true; })) {
        for (std::int32_t point = 0; point < mesh.points(); ++point)
            points_.push_back(old_point(point));
        for (const Edge& edge : edges_)
            points_.push_back(middle(old_point(edge.a), old_point(edge.b)));
        for (std::int32_t cell = 0; cell < mesh.cells(); ++cell) divide(cell);
    }

    void place_boundary(const std::function<Point(std::int32_t, Point, Point)>& on_boundary) {
        for (std::int32_t face = 0; face < mesh_.faces(); ++face) {
            const std::int32_t a = end(face, 0), b = end(face, 1);
            points_[static_cast<std::size_t>(between(a, b))] = on_boundary(
                mesh_.face_markers[static_cast<std::size_t>(face)], old_point(a), old_point(b));
        }
    }

    void write(std::ostream& out) const {
        out << "NDIME= 2\nNELEM= " << cells_.size() << '\n';
        for (const std::vector<std::int32_t>& cell : cells_) {
            out << (cell.size() == 3 ? 5 : 9);
            for (const std::int32_t point : cell) out << ' ' << point;
            out << '\n';
        }
        out << "NPOIN= " << points_.size() << '\n';
        for (const Point& point : points_) out << exact(point.x) << ' ' << exact(point.y) << '\n';
        out << "NMARK= " << mesh_.markers.size() << '\n';
        for (std::size_t marker = 0; marker < mesh_.markers.size(); ++marker) {
            const auto number = static_cast<std::int32_t>(marker);
            out << "MARKER_TAG= " << mesh_.markers[marker]
                << "\nMARKER_ELEMS= " << 2 * mesh_.faces(number) << '\n';
            for (std::int32_t face = 0; face < mesh_.faces(); ++face) {
                if (mesh_.face_markers[static_cast<std::size_t>(face)] != number) continue;
                const std::int32_t a = end(face, 0), b = end(face, 1), half_way = between(a, b);
                out << "3 " << a << ' ' << half_way << "\n3 " << half_way << ' ' << b << '\n';
            }
        }
    }

private:
    static Point middle(Point a, Point b) { return {.5 * (a.x + b.x), .5 * (a.y + b.y)}; }
    Point old_point(std::int32_t point) const {
        return {mesh_.x[static_cast<std::size_t>(point)], mesh_.y[static_cast<std::size_t>(point)]};
    }
    std::int32_t end(std::int32_t face, std::int32_t which) const {
        return mesh_.face_points[static_cast<std::size_t>(2 * face + which)];
    }

    // Returns the new point on the edge between two old points.
    std::int32_t between(std::int32_t a, std::int32_t b) const {
        const Edge edge = {std::min(a, b), std::max(a, b)};
        const auto found = std::lower_bound(edges_.begin(), edges_.end(), edge, precedes);
        return mesh_.points() + static_cast<std::int32_t>(found - edges_.begin());
    }

    void divide(std::int32_t cell) {
        const auto begin =
            static_cast<std::size_t>(mesh_.cell_start[static_cast<std::size_t>(cell)]);
        const auto n =
            static_cast<std::size_t>(mesh_.cell_start[static_cast<std::size_t>(cell) + 1]) - begin;
        const auto corner = [&](std::size_t k) { return mesh_.cell_points[begin + k % n]; };
        std::int32_t centre = -1;
        if (n == 4) {
            centre = static_cast<std::int32_t>(points_.size());
            points_.push_back(middle(middle(old_point(corner(0)), old_point(corner(1))),
                                     middle(old_point(corner(2)), old_point(corner(3)))));
        } else {
            cells_.push_back({between(corner(0), corner(1)), between(corner(1), corner(2)),
                              between(corner(2), corner(0))});
        }
        for (std::size_t k = 0; k < n; ++k) {
            const std::int32_t before = between(corner(k + n - 1), corner(k)),
                               after = between(corner(k), corner(k + 1));
            cells_.push_back({corner(k), after});
            if (n == 4) cells_.back().push_back(centre);
            cells_.back().push_back(before);
        }
    }

    const Mesh& mesh_;
    std::vector<Edge> edges_;
    // The old points, then one point on each edge and one in each quadrilateral.
    std::vector<Point> points_;
    std::vector<std::vector<std::int32_t>> cells_;
};

}  // namespace

void write_refined(std::ostream& out, const Mesh& mesh,
                   const std::function<Point(std::int32_t, Point, Point)>& on_boundary) {
    Refined refined(mesh);
    refined.place_boundary(on_boundary);
    refined.write(out);
}

}  // namespace cli
