// The C interface: fits B-splines to the walls of a mesh.
#include <limits>

#include "base/vec2.hpp"
#include "fitted_set.hpp"
#include "request.hpp"

namespace harmorph {
namespace {

// The walls of a mesh that are to be fitted, from the caller's arguments.
struct WallRequest {
    Request request;  // the mesh alone
    Span<const Index> markers;
    FitOptions options;

    Status read(const hm_mesh* mesh, Index n_markers, const Index* given,
                const hm_fit_options* fit_options, CallFault& fault) noexcept {
        HARMORPH_TRY(require({{"markers", given}}, fault));
        if (n_markers < 1) {
            return fault.refuse(Status::bad_argument, "n_markers must be at least 1, not #",
                                plain(n_markers));
        }
        markers = {given, static_cast<Size>(n_markers)};
        HARMORPH_TRY(view_fit_options(fit_options, options, fault));
        hm_problem problem = {};
        problem.struct_size = sizeof problem;
        problem.mesh = mesh;
        HARMORPH_TRY(request.read(&problem, nullptr, fault));
        HARMORPH_TRY(check_fit_weights(options, request.problem.mesh.n_points, fault));
        return check_fit(options.n_control, options, fault);
    }
    // A piece has more points than the degree, and a face has two points; these limits bound all
    // arrays of the curves.
    void lay_out_curves(Arena& arena, FittedSet& made) const noexcept {
        Offset const pieces = max_faces() / options.degree;
        Offset const points = 2 * max_faces(), wanted = pieces * options.n_control;
        made.lay_out(arena, pieces, min(points, wanted), options.degree);
    }
    Offset max_faces() const noexcept {
        return static_cast<Offset>(Boundary::max_faces(request.problem.mesh));
    }
    // A piece of the boundary has at most one point more than it has faces.
    Index max_points() const noexcept {
        constexpr Offset limit = std::numeric_limits<Index>::max() - 2 * max_order;
        return static_cast<Index>(min(max(max_faces() + 1, Offset{options.n_control}), limit));
    }
};

// The block of hm_fit_marker: the curves of all pieces, in one set, and behind them the analysis of
// the mesh, the points of a piece and the fit.
struct WallBlock {
    FittedSet made;
    Analysis analysis;
    Span<Index> point;  // of the piece
    Span<Real> x, y;
    Span<Real> weight;         // of these points; empty without weights
    Span<unsigned char> room;  // of the fit of any piece

    void lay_out(Arena& arena, WallRequest const& wall) noexcept {
        Index const max_points = wall.max_points();
        wall.lay_out_curves(arena, made);
        analysis.lay_out(arena, wall.request.problem, 0, 0);
        arena.take(point, max_points);
        arena.take(x, max_points);
        arena.take(y, max_points);
        arena.take(weight, wall.options.weight == nullptr ? 0 : max_points);
        Arena counting;
        Fit().lay_out(counting, max_points, wall.options);
        arena.take(room, counting.bytes());
    }
};

class WallFit {
public:
    WallFit(WallRequest const& wall, WallBlock& work) noexcept : wall_(wall), work_(work) {}

    Status run(hm_fit_report& report, CallFault& fault) noexcept {
        HARMORPH_TRY(work_.analysis.run(wall_.request.problem, fault));
        Boundary const& boundary = work_.analysis.boundary();
        for (Index const marker : wall_.markers) {
            if (boundary.has_marker(marker)) continue;
            return fault.refuse(Status::bad_condition, "no face of the boundary has the marker #",
                                marker_item(marker));
        }
        auto const is_on = [&](Index face) {
            return contains(wall_.markers, boundary.marker[face]);
        };
        auto const visit = [&](Index, Index point) { work_.point[n_points_++] = point; };
        auto const close = [&](Index, bool is_loop) {
            if (!failed(fault.status)) fit_piece(is_loop, fault);
            n_points_ = 0;
        };
        Index const n_pieces = boundary.for_each_chain(is_on, visit, close);
        report = report_of(worst_, n_pieces, 0);
        return fault.status;
    }

private:
    Index number_of(Index position) const noexcept {
        if (position == none) return none;
        return work_.point[position] + wall_.request.problem.mesh.index_base;
    }
    // Replaces the position in a piece, which the fit names, by the point of the mesh.
    void name_point(Item& item) const noexcept {
        if (item.kind == ItemKind::point) item = point_item(work_.point[item.number]);
    }
    // Refuses a piece that begins and ends with the two sides of a cut, as the line of a C-mesh
    // that contains the airfoil and its wake.
    Status check_cut(CallFault& fault) const noexcept {
        constexpr Real rounding = 1e-9;  // of the face
        Points const points = wall_.request.problem.mesh.points;
        Index n = 0;
        while (2 * (n + 2) < n_points_) {
            Vec2 const one = points[work_.point[n]], other = points[work_.point[n_points_ - 1 - n]];
            Real const face = length(points[work_.point[n + 1]] - one);
            if (length(other - one) > rounding * face) break;
            ++n;
        }
        if (n < 2) return Status::ok;
        return fault.refuse(Status::bad_condition,
                            "the marker has both sides of a cut, which meet the body at points # "
                            "and @; leave the faces of the cut without a marker",
                            point_item(work_.point[n - 1]), point_item(work_.point[n_points_ - n]));
    }
    void fit_piece(bool is_loop, CallFault& fault) noexcept {
        Points const points = wall_.request.problem.mesh.points;
        if (!is_loop && failed(check_cut(fault))) return;
        for (Index k = 0; k < n_points_; ++k) {
            work_.x[k] = points[work_.point[k]].x;
            work_.y[k] = points[work_.point[k]].y;
        }
        Fit fit;
        FitOptions options = wall_.options;
        if (options.weight != nullptr) {
            for (Index k = 0; k < n_points_; ++k) work_.weight[k] = options.weight[work_.point[k]];
            options.weight = work_.weight.data();
        }
        FitReport fitted;
        if (failed(check_fit(n_points_, wall_.options, fault))) return;
        Arena arena(work_.room.data(), work_.room.size());
        fit.lay_out(arena, n_points_, wall_.options);
        fit.run({work_.x.data(), work_.y.data(), 1}, n_points_, is_loop, options, fitted, fault);
        name_point(fault.item);
        name_point(fault.other);
        if (failed(fault.status)) return;
        if (work_.made.n_curves == 0 || fitted.max_error > worst_.max_error) {
            worst_ = fitted;
            worst_.max_error_point = number_of(fitted.max_error_point);
            worst_.first_point = number_of(fitted.first_point);
            worst_.backtrack_point = number_of(fitted.backtrack_point);
            worst_.departure_point = number_of(fitted.departure_point);
        }
        work_.made.add(fit);
    }

    WallRequest const& wall_;
    WallBlock& work_;
    Index n_points_ = 0;
    FitReport worst_;
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_fit_marker(const hm_curves** curves, hm_memory* memory, const hm_mesh* mesh,
                        int32_t n_markers, const int32_t* markers, const hm_fit_options* options,
                        hm_fit_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        WallRequest wall;
        HARMORPH_TRY(wall.read(mesh, n_markers, markers, options, fault));
        WallBlock made;
        hm_fit_report fitted = {};
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) { made.lay_out(arena, wall); }));
        HARMORPH_TRY(require({{"curves", curves}}, fault));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        HARMORPH_TRY(WallFit(wall, made).run(fitted, fault));
        *curves = made.made.present(memory->block, memory->bytes, fitted.bytes);
        if (report != nullptr) write_struct(fitted, report);
        return fault.status;
    });
}

}  // extern "C"
