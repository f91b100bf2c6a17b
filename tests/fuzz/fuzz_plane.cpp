// Plane meshes as solvers with three dimensions have them: layers of points in any order, along a
// coordinate, inclined, or turned about an axis. Of what the library takes, each point follows the
// point of the plane that it was made from; spreading and gathering are transposes; and a mesh with
// something wrong is refused, or a plane mesh all the same.
#include <harmorph_space.h>
#include "exceptions.hpp"
#include "solution.hpp"
#include "target.hpp"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <fixtures/memory.hpp>

namespace fuzz {
namespace {

using Vec3 = std::array<double, 3>;
using Numbers = std::vector<double>;

struct Frame {
    Vec3 origin{}, along{1, 0, 0}, up{0, 1, 0}, across{0, 0, 1};
    bool is_wedge = false;
    double step = 0.5;  // from layer to layer: a length, or an angle

    Vec3 place(Point p, std::int32_t layer) const {
        double const angle = is_wedge ? step * layer : 0;
        double const height = p.y * std::cos(angle),
                     depth = is_wedge ? p.y * std::sin(angle) : step * layer;
        Vec3 out{};
        for (std::size_t d = 0; d < 3; ++d)
            out[d] = origin[d] + p.x * along[d] + height * up[d] + depth * across[d];
        return out;
    }
};

// A domain, extruded.
class Space {
public:
    Space(Problem const& problem, Input& input) : domain_(problem.domain) {
        std::uint32_t const how = input.below(4);
        double const c = std::cos(0.7), s = std::sin(0.7);
        if (how == 1) frame_.up = {0, 0, 1}, frame_.across = {0, -1, 0};
        if (how == 2) frame_.along = {c, s, 0}, frame_.up = {0, 0, 1}, frame_.across = {s, -c, 0};
        frame_.is_wedge = how == 3;
        double const size = problem.size();
        frame_.step = frame_.is_wedge ? 0.05 : 0.3 * size;
        layers_ = input.from(1, 3);
        double lift = 0;  // a wedge's mesh lies on one side of its axis
        for (Point const& p : domain_.points) lift = std::max(lift, -p.y);
        if (frame_.is_wedge) lift += size;
        std::vector<Point> const& points = domain_.points;
        double reach = 0;  // the largest coordinate, whose rounding the points in space have
        for (Point const& p : points)
            reach = std::max({reach, std::abs(p.x), std::abs(p.y) + lift});
        for (std::size_t k = 0; k < points.size(); ++k)
            for (std::size_t other = 0; other < k; ++other) {
                double const dx = points[k].x - points[other].x, dy = points[k].y - points[other].y;
                double const distance = std::hypot(dx, dy);
                has_twins = has_twins || distance <= 1e-6 * reach;
                is_accurate = is_accurate && (distance == 0 || distance > 1e-6 * reach);
            }
        std::size_t const n = domain_.points.size();
        std::vector<std::int32_t> order(n * at(layers_));
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<std::int32_t>(k);
        if (input.one_in(2))
            for (std::size_t k = order.size(); k > 1; --k)
                std::swap(order[k - 1], order[input.below(static_cast<std::uint32_t>(k))]);
        x.resize(order.size()), y = z = x;
        plane_point.resize(order.size());
        for (std::int32_t layer = 0; layer < layers_; ++layer)
            for (std::size_t k = 0; k < n; ++k) {
                std::size_t const at = number(order, layer, static_cast<std::int32_t>(k));
                Point const p = domain_.points[k];
                Vec3 const place = frame_.place({p.x, p.y + lift}, layer);
                x[at] = place[0], y[at] = place[1], z[at] = place[2];
                plane_point[at] = static_cast<std::int32_t>(k);
            }
        space.struct_size = sizeof space;
        space.index_base = input.from(0, 1);
        space.n_points = static_cast<std::int32_t>(x.size());
        space.points = {x.data(), y.data(), z.data(), 1};
        start_.push_back(space.index_base);
        for (Cell const& cell : domain_.cells) {
            for (std::int32_t const k : cell) faces_.push_back(numbered(order, 0, k));
            start_.push_back(static_cast<std::int32_t>(faces_.size()) + space.index_base);
        }
        for (std::int32_t layer = 0; layer + 1 < layers_; ++layer)
            for (Face const& face : domain_.faces) {
                sides_.push_back(numbered(order, layer, face.from));
                sides_.push_back(numbered(order, layer, face.to));
                sides_.push_back(numbered(order, layer + 1, face.to));
                sides_.push_back(numbered(order, layer + 1, face.from));
                markers_.push_back(face.marker);
            }
        space.n_faces = static_cast<std::int32_t>(start_.size()) - 1;
        space.face_start = start_.data();
        space.face_points = faces_.data();
        space.n_sides = static_cast<std::int32_t>(markers_.size());
        space.side_points = sides_.data();
        space.side_markers = markers_.data();
        if (frame_.is_wedge && (layers_ != 2 || input.one_in(2))) {
            space.kind = HM_WEDGE;
            space.axis[0] = 1;
        }
    }

    void spoil(Input& input) {
        auto const some = [&](auto& from) -> auto& {
            return from[input.below(static_cast<std::uint32_t>(from.size()))];
        };
        switch (input.below(9)) {
            case 0: some(x) = input.wild(); break;
            case 1: some(z) += 0.1; break;
            case 2: some(faces_) = input.wild_index(); break;
            case 3:
                if (!sides_.empty())
                    some(sides_) = input.one_in(2) ? input.wild_index() : some(faces_);
                break;
            case 4: some(start_) = some(start_); break;
            case 5: space.kind = input.from(-1, 3); break;
            case 6: space.axis[input.below(3)] = input.wild(); break;
            case 7: space.tolerance = input.wild(); break;
            default: some(y) = some(y);
        }
    }

    hm_space_mesh space{};
    Numbers x, y, z;
    // Points of the plane are in one place but for rounding: numbers decide who follows whom.
    bool has_twins = false;
    bool is_accurate = true;  // all other points are apart, in spite of the rounding in space
    std::vector<std::int32_t> plane_point;  // of each point of space: the point of the domain

private:
    std::size_t number(std::vector<std::int32_t> const& order, std::int32_t layer,
                       std::int32_t k) const {
        std::size_t const n = domain_.points.size();
        return at(order[static_cast<std::size_t>(layer) * n + static_cast<std::size_t>(k)]);
    }
    std::int32_t numbered(std::vector<std::int32_t> const& order, std::int32_t layer,
                          std::int32_t k) const {
        return static_cast<std::int32_t>(number(order, layer, k)) + space.index_base;
    }

    Domain const& domain_;
    Frame frame_;
    std::int32_t layers_ = 2;
    std::vector<std::int32_t> start_, faces_, sides_, markers_;
};

class Layers {
public:
    Layers(Space& space, hm_plane* plane) : space_(space), plane_(plane) {
        expect(hm_plane_info_get(plane_, &info_, nullptr) == HM_OK, "no information about a plane");
        expect(hm_plane_mesh(plane_, &mesh_, nullptr) == HM_OK, "no mesh of a plane");
        expect(mesh_.n_points == info_.n_points && info_.n_space_points == space.space.n_points,
               "counts differ");
    }

    // Points that were one point of the domain follow one point of the plane, and no others do.
    void followers() const {
        std::map<std::int32_t, std::int32_t> leader;
        for (std::int32_t k = 0; k < info_.n_space_points; ++k) {
            std::int32_t const followed = info_.follows[k] - mesh_.index_base;
            expect(followed >= 0 && followed < info_.n_points, "a point follows none");
            auto const found = leader.insert({space_.plane_point[at(k)], followed}).first;
            expect(found->second == followed, "layers follow different points");
        }
    }

    // Both ends of an edge from one layer to the next follow one point of the plane.
    void sides() const {
        hm_space_mesh const& space = space_.space;
        for (std::int32_t i = 0; i < space.n_sides; ++i) {
            auto const followed = [&](std::int32_t k) {
                return info_.follows[space.side_points[4 * i + k] - space.index_base];
            };
            expect(followed(0) == followed(3) && followed(1) == followed(2),
                   "the two ends of an edge between layers follow different points");
        }
    }

    // <g, spread d> = <gather g, d>, and d = 0 moves no bit.
    void transpose(Input& input) {
        std::size_t const n = at(info_.n_points), all = space_.x.size();
        Numbers dx(n), dy(n), gx(all), gy(all), gz(all), sx(all, 7), sy(all, 7), sz(all, 7),
            px(n, 7), py(n, 7);
        for (std::size_t k = 0; k < n; ++k)
            dx[k] = input.between(-1, 1), dy[k] = input.between(-1, 1);
        for (std::size_t k = 0; k < all; ++k)
            gx[k] = input.between(-1, 1), gy[k] = input.between(-1, 1),
            gz[k] = input.between(-1, 1);
        hm_points const d{dx.data(), dy.data(), 1};
        hm_space_points const g{gx.data(), gy.data(), gz.data(), 1}, from = space_.space.points;
        hm_space_points_out const to{sx.data(), sy.data(), sz.data(), 1};
        hm_points_out const gathered{px.data(), py.data(), 1};
        expect(hm_plane_spread(plane_, &d, nullptr, &to, nullptr, nullptr) == HM_OK,
               "nothing is spread");
        expect(hm_plane_gather(plane_, &g, &gathered, nullptr, nullptr) == HM_OK,
               "nothing is gathered");
        long double left = 0, right = 0, size = 0;
        for (std::size_t k = 0; k < all; ++k) {
            long double const term = static_cast<long double>(gx[k]) * sx[k] +
                                     static_cast<long double>(gy[k]) * sy[k] +
                                     static_cast<long double>(gz[k]) * sz[k];
            left += term;
            size += std::abs(gx[k] * sx[k]) + std::abs(gy[k] * sy[k]) + std::abs(gz[k] * sz[k]);
        }
        for (std::size_t k = 0; k < n; ++k)
            right +=
                static_cast<long double>(px[k]) * dx[k] + static_cast<long double>(py[k]) * dy[k];
        expect(std::abs(left - right) <= 1e-13L * size,
               "what is gathered is not the transpose of what is spread");
        std::fill(dx.begin(), dx.end(), 0.0);
        std::fill(dy.begin(), dy.end(), 0.0);
        expect(hm_plane_spread(plane_, &d, &from, &to, nullptr, nullptr) == HM_OK,
               "nothing is spread");
        for (std::size_t k = 0; k < all; ++k) {
            bool const same = sx[k] == space_.x[k] && sy[k] == space_.y[k] && sz[k] == space_.z[k];
            expect(same, "a point that stays has other bits");
        }
    }

private:
    Space& space_;
    hm_plane* plane_;
    hm_plane_info info_ = sized<hm_plane_info>();
    hm_mesh mesh_ = sized<hm_mesh>();
};

}  // namespace

Outcome run_plane(Input& input) {
    std::unique_ptr<Problem> const problem = make_problem(input);
    Space space(*problem, input);
    bool const is_broken = input.one_in(2);
    if (is_broken) space.spoil(input);
    Blocks blocks(input);
    hm_error error{};
    hm_plane* plane = nullptr;
    hm_status const status = blocks.make(error, size_by(fixtures::plane_size, &space.space),
                                         init_by(hm_plane_init, &plane, &space.space));
    std::string const text = error.text;
    bool const is_apart = text.find("has no opposite point") != text.npos ||
                          text.find("points of the plane, but must") != text.npos;
    if (!is_broken && space.is_accurate) expect(!is_apart, error.text);
    if (status < 0) return Outcome::refused;
    Layers layers(space, plane);
    if (!is_broken) layers.sides();
    if (!is_broken && !space.has_twins) layers.followers();
    layers.transpose(input);
    blocks.expect_intact();
    return Outcome::done;
}

}  // namespace fuzz
