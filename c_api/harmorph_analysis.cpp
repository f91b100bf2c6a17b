// The C interface: makes the analysis of a problem, and reports on the mesh and its boundary.
#include "request.hpp"
#include "morph/quality.hpp"

namespace harmorph {
namespace {

hm_mesh_report report_of(Analysis const& analysis) noexcept {
    Mesh const& mesh = analysis.problem().mesh;
    Quality const quality =
        measure_quality(analysis.topology(), mesh.points, {}, analysis.problem().executor);
    hm_mesh_report filled = {};
    filled.points = mesh.n_points;
    filled.used_points = analysis.count_used_points();
    filled.cells = mesh.n_given_cells();
    mesh.for_each_cell([&](Index i, Cell const& cell) {
        if (!mesh.is_piece_or_guard(i)) ++(cell.n == 3 ? filled.triangles : filled.quads);
    });
    filled.polygons = filled.cells - filled.triangles - filled.quads;
    filled.edges = analysis.topology().edges.count() -
                   (mesh.n_cells - filled.cells);  // diagonals of polygons do not count
    filled.boundary_edges = analysis.boundary().count;
    filled.boundary_loops = analysis.boundary().n_loops;
    filled.inverted = quality.inverted;
    filled.first_inverted = numbered(quality.first_inverted, mesh.index_base);
    filled.min_area = quality.min_area;
    filled.min_quality = quality.min_quality;
    filled.mean_quality = quality.mean_quality();
    return filled;
}

// One of the pieces of the boundary that the given markers form.
struct Piece {
    Index number;
    Index n_points = 0;
    bool is_loop = false;
    Index n_pieces = 0;  // number of all pieces

    // Finds the points of the piece. points is NULL, or has room for all of them.
    void find(Analysis const& analysis, Span<const Index> markers, Index* points) noexcept {
        n_points = 0;
        Boundary const& boundary = analysis.boundary();
        auto const is_on = [&](Index face) { return contains(markers, boundary.marker[face]); };
        auto const visit = [&](Index piece, Index point) {
            if (piece != number) return;
            if (points != nullptr) points[n_points] = point + analysis.problem().mesh.index_base;
            ++n_points;
        };
        auto const close = [&](Index piece, bool loop) {
            if (piece == number) is_loop = loop;
        };
        n_pieces = boundary.for_each_chain(is_on, visit, close);
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_analysis_init(hm_analysis** analysis, hm_memory* memory, const hm_problem* problem,
                           const hm_options* options, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        Request request;
        HARMORPH_TRY(request.read(problem, options, fault));
        InBlock<Analysis> made;
        HARMORPH_TRY(place(memory, fault, [&](Arena& arena) {
            made.lay_out(arena, request.problem, request.n_curves, request.n_conditions);
        }));
        HARMORPH_TRY(require({{"analysis", analysis}}, fault));
        HARMORPH_TRY(request.copy_to(made.object.curves(), made.object.slip_along(),
                                     made.object.conditions(), fault));
        HARMORPH_TRY(made.object.run(request.problem, fault));
        made.give(analysis);
        return fault.status;
    });
}

hm_status hm_analysis_report(const hm_analysis* analysis, hm_mesh_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        HARMORPH_TRY(open_analysis(analysis, opened, fault));
        HARMORPH_TRY(check_report(report, "report", fault));
        write_struct(report_of(*opened), report);
        return Status::ok;
    });
}

hm_status hm_analysis_boundary(const hm_analysis* analysis, int32_t n_markers,
                               const int32_t* markers, int32_t piece, int32_t* points,
                               int32_t capacity, int32_t* n, int32_t* is_loop, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Analysis* opened = nullptr;
        HARMORPH_TRY(open_analysis(analysis, opened, fault));
        HARMORPH_TRY(require({{"markers", markers}, {"n", n}, {"is_loop", is_loop}}, fault));
        if (n_markers < 1 || capacity < 0) {
            return fault.refuse(Status::bad_argument,
                                "n_markers is # and capacity is @; n_markers must be at least 1, "
                                "and capacity at least 0",
                                plain(n_markers), plain(capacity));
        }
        if (capacity > 0) HARMORPH_TRY(require({{"points", points}}, fault));
        Span<const Index> const asked(markers, static_cast<Size>(n_markers));
        Piece found{piece};
        found.find(*opened, asked, nullptr);
        if (found.n_pieces == 0) {
            return fault.refuse(
                Status::bad_condition,
                "no face of the boundary has one of the given markers, the first of which is #",
                marker_item(markers[0]));
        }
        if (piece < 0 || piece >= found.n_pieces) {
            return fault.refuse(
                Status::bad_condition,
                "the given markers form # pieces of the boundary, so piece @ does not exist",
                plain(found.n_pieces), entry_item(piece));
        }
        *n = found.n_points;
        if (found.n_points > capacity) {
            return fault.refuse(
                Status::bad_argument,
                "points has room for # points, but this piece of the boundary has @",
                plain(capacity), plain(found.n_points));
        }
        found.find(*opened, asked, points);
        *is_loop = found.is_loop ? 1 : 0;
        return Status::ok;
    });
}

}  // extern "C"
