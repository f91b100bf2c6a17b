// The C interface, part 1: versions, and the way from a problem to solved functions. The only extern "C" besides the other
// harmorph_*.cpp here.
#include "harmorph.h"

#include "fault_text.hpp"
#include "harmorph/plan/plan.hpp"
#include "harmorph/basis/basis_measures.hpp"
#include "harmorph/morph/quality.hpp"
#include "views.hpp"

namespace harmorph {
namespace {

const Analysis& opened(const hm_analysis* analysis) noexcept { return *reinterpret_cast<const Analysis*>(analysis); }
Plan& opened(hm_plan* plan) noexcept { return *reinterpret_cast<Plan*>(plan); }

// A problem read from the caller's structs, before anything is laid out.
struct Request {
    Problem problem;
    CurvesView curves;
    Index n_curves = 0;
    const hm_condition* condition = nullptr;
    Index n_conditions = 0;

    Status read(const hm_problem* given, const hm_options* options, Fault& fault) noexcept {
        if (given == nullptr) return fault.refuse(Status::bad_argument, "problem is NULL");
        hm_problem p;
        if (!read_struct(given, p)) return fault.refuse(Status::bad_argument, "problem.struct_size is not set");
        HARMORPH_TRY(view_mesh(p.mesh, problem.mesh, fault));
        HARMORPH_TRY(view_options(options, problem, fault));
        if (p.curves != nullptr) {
            HARMORPH_TRY(view_curves(p.curves, curves, fault));
            n_curves = curves.count();
        }
        HARMORPH_TRY(read_conditions(p, fault));
        if (p.n_given < 0 || (p.n_given > 0 && (!p.given_points || !p.given_curves || !p.given_u))) {
            return fault.refuse(Status::bad_argument, "given parameters: negative number, or an array is NULL");
        }
        Size const n = static_cast<Size>(p.n_given);
        problem.given = {problem.mesh.index_base, {p.given_points, n}, {p.given_curves, n}, {p.given_u, n}};
        return Status::ok;
    }

    // Without curves and rigid bodies nothing is to be solved, and conditions do not count.
    Status read_conditions(hm_problem const& p, Fault& fault) noexcept {
        if (p.n_conditions < 0 || (p.n_conditions > 0 && p.conditions == nullptr)) {
            return fault.refuse(Status::bad_argument, "n_conditions is negative, or conditions is NULL");
        }
        for (Index i = 0; i < p.n_conditions; ++i) {
            Condition its;
            HARMORPH_TRY(view_condition(p.conditions, i, its, fault));
            problem.demands.add(its);
        }
        if (n_curves == 0 && problem.demands.bodies == 0) return Status::ok;
        if (p.n_conditions == 0) {
            return fault.refuse(Status::bad_condition, "there are curves, but no condition that puts a marker on one");
        }
        condition = p.conditions;
        n_conditions = p.n_conditions;
        if (problem.demands.slip && problem.method.bounded()) {
            return fault.refuse(Status::unsupported, "the bounded scheme does not go with slipping boundaries");
        }
        if (problem.demands.slip && problem.method.nodal_gradients()) {
            return fault.refuse(Status::unsupported, "schemes of nodal gradients do not go with slipping boundaries");
        }
        if (problem.demands.slip && problem.method.engine != Engine::direct) {
            return fault.refuse(Status::unsupported, "slipping boundaries go with the direct engine only");
        }
        if (!problem.demands.free || !problem.method.conformal()) return Status::ok;
        return fault.refuse(Status::unsupported, "the conformal operator does not go with free boundaries; slipping ones do");
    }

    void lay_out(Arena& arena, Span<Analysis>& place, Analysis& analysis) const noexcept {
        arena.take(place, 1);
        analysis.lay_out(arena, problem, n_curves, n_conditions);
    }

    Status copy_to(Analysis& analysis, Fault& fault) const noexcept {
        for (Index i = 0; i < n_curves; ++i) HARMORPH_TRY(curves.curve(i, analysis.curves[i], fault));
        for (Index i = 0; i < n_conditions; ++i) {
            HARMORPH_TRY(view_condition(condition, i, analysis.conditions[i], fault));
        }
        return Status::ok;
    }

    Bases bases() const noexcept { return {problem.mesh.index_base, n_curves > 0 ? curves.set.index_base : 0}; }
};

Status analyse(const Request& request, void* block, Size bytes, hm_analysis** out, Fault& fault) noexcept {
    Arena arena(block, bytes);
    Span<Analysis> place;
    Analysis analysis;
    request.lay_out(arena, place, analysis);
    HARMORPH_TRY(arena.verify(bytes, fault));
    HARMORPH_TRY(request.copy_to(analysis, fault));
    HARMORPH_TRY(analysis.run(request.problem, fault));
    place[0] = analysis;
    *out = reinterpret_cast<hm_analysis*>(place.data());
    return Status::ok;
}

Status require_conditions(const hm_analysis* analysis, const void* out, Fault& fault) noexcept {
    if (analysis == nullptr || out == nullptr) return fault.refuse(Status::bad_argument, "an argument is NULL");
    if (opened(analysis).has_conditions()) return Status::ok;
    return fault.refuse(Status::bad_argument, "the analysis is of the mesh alone: its problem had no conditions");
}

void lay_out_plan(Arena& arena, Analysis const& analysis, Span<Plan>& place, Plan& plan) noexcept {
    arena.take(place, 1);
    plan.lay_out(arena, analysis);
}

Status count_size(Arena const& arena, size_t* bytes, Fault& fault) noexcept {
    HARMORPH_TRY(arena.verify(0, fault));
    *bytes = arena.bytes();
    return Status::ok;
}

Status size_basis(BasisCounts const& counts, size_t* bytes, Fault& fault) noexcept {
    Arena counting;
    Basis basis;
    basis.lay_out(counting, counts);
    return count_size(counting, bytes, fault);
}

Status make_basis(Analysis const& analysis, BasisCounts const& counts, void* block, Size bytes, hm_basis** out,
                  Fault& fault) noexcept {
    if (block == nullptr) return fault.refuse(Status::bad_argument, "block is NULL");
    Arena arena(block, bytes);
    Basis made;
    made.lay_out(arena, counts);
    HARMORPH_TRY(arena.verify(bytes, fault));
    init_basis(made, counts, analysis.basis_source());
    *out = reinterpret_cast<hm_basis*>(made.header);
    return Status::ok;
}

Status count_share(Analysis const& analysis, Index first, Index n, BasisCounts& counts, Fault& fault) noexcept {
    BasisCounts const all = analysis.basis_counts();
    if (first < 0 || n < 0 || n > all.functions() - first) {
        return fault.refuse(Status::bad_argument, "from function # (from 0) on there are no @ functions", Counts::from_zero, first,
                            n);
    }
    counts = all.share(first, n);
    return Status::ok;
}

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

int32_t hm_abi_version(void) { return HM_ABI; }
const char* hm_version(void) { return HM_VERSION; }

const char* hm_status_name(hm_status status) {
    switch (status) {
        case HM_OK: return "HM_OK";
        case HM_NOT_CONVERGED: return "HM_NOT_CONVERGED";
        case HM_MOVED: return "HM_MOVED";
        case HM_SHORT: return "HM_SHORT";
        case HM_BACKTRACKS: return "HM_BACKTRACKS";
        case HM_FAR_FROM_CURVE: return "HM_FAR_FROM_CURVE";
        case HM_CANCELLED: return "HM_CANCELLED";
        case HM_BAD_ARGUMENT: return "HM_BAD_ARGUMENT";
        case HM_BAD_MESH: return "HM_BAD_MESH";
        case HM_BAD_CURVE: return "HM_BAD_CURVE";
        case HM_BAD_CONDITION: return "HM_BAD_CONDITION";
        case HM_BAD_BASIS: return "HM_BAD_BASIS";
        case HM_BLOCK_TOO_SMALL: return "HM_BLOCK_TOO_SMALL";
        case HM_NOT_POSITIVE: return "HM_NOT_POSITIVE";
        case HM_UNSUPPORTED: return "HM_UNSUPPORTED";
        case HM_CROSSING: return "HM_CROSSING";
        default: return "unknown status";
    }
}

hm_status hm_analysis_size(const hm_problem* problem, const hm_options* options, size_t* bytes, hm_error* err) {
    Fault fault;
    Request request;
    if (bytes == nullptr) fault.refuse(Status::bad_argument, "bytes is NULL");
    if (!failed(fault.status) && !failed(request.read(problem, options, fault))) {
        Arena counting;
        Span<Analysis> place;
        Analysis analysis;
        request.lay_out(counting, place, analysis);
        count_size(counting, bytes, fault);
    }
    return tell(err, fault, request.bases());
}

hm_status hm_analysis_init(hm_analysis** analysis, void* block, size_t bytes, const hm_problem* problem,
                           const hm_options* options, hm_error* err) {
    Fault fault;
    Request request;
    if (analysis == nullptr || block == nullptr) fault.refuse(Status::bad_argument, "analysis or block is NULL");
    if (!failed(fault.status) && !failed(request.read(problem, options, fault))) {
        analyse(request, block, bytes, analysis, fault);
    }
    return tell(err, fault, request.bases());
}

hm_status hm_analysis_report(const hm_analysis* analysis, hm_mesh_report* report, hm_error* err) {
    Fault fault;
    if (analysis == nullptr) fault.refuse(Status::bad_argument, "analysis is NULL");
    if (failed(fault.status) || failed(check_report(report, fault))) return tell(err, fault);
    Analysis const& a = opened(analysis);
    Mesh const& mesh = a.problem.mesh;
    Quality const quality = measure_quality(a.topology, mesh.points, {}, a.problem.executor);
    hm_mesh_report filled = {};
    filled.points = mesh.n_points;
    filled.used_points = a.count_used_points();
    filled.cells = mesh.n_cells;
    for (Index i = 0; i < mesh.n_cells; ++i) ++(mesh.cell(i).n == 3 ? filled.triangles : filled.quads);
    filled.edges = a.topology.edges.count();
    filled.boundary_edges = a.boundary.count;
    filled.boundary_loops = a.boundary.n_loops;
    filled.inverted = quality.inverted;
    filled.first_inverted = quality.first_inverted == none ? none : quality.first_inverted + mesh.index_base;
    filled.min_area = quality.min_area;
    filled.min_quality = quality.min_quality;
    filled.mean_quality = quality.mean_quality();
    write_struct(filled, report);
    return tell(err, fault);
}

hm_status hm_analysis_boundary(const hm_analysis* analysis, int32_t n_markers, const int32_t* markers, int32_t piece,
                               int32_t* points, int32_t capacity, int32_t* n, int32_t* is_loop, hm_error* err) {
    Fault fault;
    if (!analysis || !markers || n_markers < 1 || !n || !is_loop || (capacity > 0 && !points) || capacity < 0) {
        fault.refuse(Status::bad_argument, "an argument is NULL, or a number is negative");
        return tell(err, fault);
    }
    Analysis const& a = opened(analysis);
    Index found = 0, closed = 0;
    Span<const Index> const wanted(markers, static_cast<Size>(n_markers));
    auto const is_on = [&](Index face) {
        for (Index const marker : wanted) {
            if (a.boundary.marker[face] == marker) return true;
        }
        return false;
    };
    auto const visit = [&](Index its_piece, Index point) {
        if (its_piece != piece) return;
        if (found < capacity) points[found] = point + a.problem.mesh.index_base;
        ++found;
    };
    auto const close = [&](Index its_piece, bool loop) { closed = its_piece == piece ? loop : closed; };
    Index const n_pieces = a.boundary.for_each_piece(is_on, visit, close);
    if (piece < 0 || piece >= n_pieces) {
        fault.refuse(Status::bad_condition, "these markers have # pieces of boundary, there is no piece @ (from 0)", Counts::from_zero,
                     n_pieces, piece);
        return tell(err, fault);
    }
    *n = found;
    *is_loop = closed;
    if (found > capacity) {
        fault.refuse(Status::bad_argument, "points has room for #, the boundary has @", Counts::from_zero, capacity, found);
    }
    return tell(err, fault);
}

hm_status hm_plan_size(const hm_analysis* analysis, size_t* bytes, hm_error* err) {
    Fault fault;
    if (!failed(require_conditions(analysis, bytes, fault))) {
        Arena counting;
        Span<Plan> place;
        Plan plan;
        lay_out_plan(counting, opened(analysis), place, plan);
        count_size(counting, bytes, fault);
    }
    return tell(err, fault);
}

hm_status hm_plan_init(hm_plan** plan, void* block, size_t bytes, const hm_analysis* analysis, hm_error* err) {
    Fault fault;
    if (block == nullptr) fault.refuse(Status::bad_argument, "block is NULL");
    if (!failed(fault.status) && !failed(require_conditions(analysis, plan, fault))) {
        Arena arena(block, bytes);
        Span<Plan> place;
        Plan made;
        lay_out_plan(arena, opened(analysis), place, made);
        if (!failed(arena.verify(bytes, fault))) {
            made.init(opened(analysis));
            place[0] = made;
            *plan = reinterpret_cast<hm_plan*>(place.data());
        }
    }
    return tell(err, fault);
}

hm_status hm_basis_size(const hm_analysis* analysis, size_t* bytes, hm_error* err) {
    Fault fault;
    if (!failed(require_conditions(analysis, bytes, fault))) {
        size_basis(opened(analysis).basis_counts(), bytes, fault);
    }
    return tell(err, fault);
}

hm_status hm_basis_init(hm_basis** basis, void* block, size_t bytes, const hm_analysis* analysis, hm_error* err) {
    Fault fault;
    if (!failed(require_conditions(analysis, basis, fault))) {
        make_basis(opened(analysis), opened(analysis).basis_counts(), block, bytes, basis, fault);
    }
    return tell(err, fault);
}

hm_status hm_share_of(const hm_analysis* analysis, int32_t part, int32_t n_parts, int32_t* first, int32_t* n, hm_error* err) {
    Fault fault;
    if (n == nullptr || part < 0 || part >= n_parts) {
        fault.refuse(Status::bad_argument, "n is NULL, or there is no part # (from 0) of @", Counts::from_zero, part, n_parts);
    } else if (!failed(require_conditions(analysis, first, fault))) {
        Offset const functions = opened(analysis).basis_counts().functions();
        *first = static_cast<Index>(functions * part / n_parts);
        *n = static_cast<Index>(functions * (part + Offset{1}) / n_parts) - *first;
    }
    return tell(err, fault);
}

hm_status hm_share_size(const hm_analysis* analysis, int32_t first, int32_t n, size_t* bytes, hm_error* err) {
    Fault fault;
    BasisCounts counts;
    if (!failed(require_conditions(analysis, bytes, fault)) &&
        !failed(count_share(opened(analysis), first, n, counts, fault))) {
        size_basis(counts, bytes, fault);
    }
    return tell(err, fault);
}

hm_status hm_share_init(hm_basis** share, void* block, size_t bytes, const hm_analysis* analysis, int32_t first, int32_t n,
                        hm_error* err) {
    Fault fault;
    BasisCounts counts;
    if (!failed(require_conditions(analysis, share, fault)) &&
        !failed(count_share(opened(analysis), first, n, counts, fault))) {
        make_basis(opened(analysis), counts, block, bytes, share, fault);
    }
    return tell(err, fault);
}

hm_status hm_plan_factor(hm_plan* plan, const hm_points* at, hm_error* err) {
    Fault fault;
    if (plan == nullptr) {
        fault.refuse(Status::bad_argument, "plan is NULL");
        return tell(err, fault);
    }
    Plan& p = opened(plan);
    Points points = p.mesh.points;
    if (!failed(view_points_if(at, "at", points, fault))) p.factor(points, fault);
    return tell(err, fault, {p.mesh.index_base, 0});
}

hm_status hm_plan_solve(hm_plan* plan, hm_basis* basis, hm_solve_report* report, hm_error* err) {
    Fault fault;
    if (plan == nullptr || basis == nullptr) {
        fault.refuse(Status::bad_argument, "plan or basis is NULL");
        return tell(err, fault);
    }
    if (report != nullptr && failed(check_report(report, fault))) return tell(err, fault);
    Plan& p = opened(plan);
    Basis const b = Basis::view(static_cast<void*>(basis));
    SolveReport solved;
    p.solve(b, solved, fault);
    if (failed(fault.status) || report == nullptr) return tell(err, fault, {p.mesh.index_base, 0});

    BasisMeasures const measures = measure_basis(b, p.mesh.points);
    auto const numbered = [&](Index point) { return point == none ? none : point + p.mesh.index_base; };
    hm_solve_report filled = {};
    filled.unknowns = solved.unknowns;
    filled.functions = solved.functions;
    filled.residual = solved.residual;
    filled.residual_function = solved.residual_function;
    filled.boundary_error_point = numbered(measures.value.point);
    filled.boundary_error = measures.value.error;
    filled.partition_defect = measures.partition_defect;
    filled.min_value = measures.min_value;
    filled.max_value = measures.max_value;
    filled.max_distance = measures.distance.error;
    filled.max_distance_point = numbered(measures.distance.point);
    filled.curve_points = b.wall_point.count();
    filled.refinements = solved.refinements;
    filled.factor_entries = solved.factor_entries;
    filled.iterations = solved.iteration.iterations;
    filled.levels = solved.iteration.levels;
    filled.fine_sweeps = solved.iteration.fine_sweeps;
    write_struct(filled, report);
    return tell(err, fault, {p.mesh.index_base, 0});
}

hm_status hm_plan_level(const hm_plan* plan, int32_t level, int32_t* cells, int32_t* n_cells, hm_error* err) {
    Fault fault;
    if (plan == nullptr || cells == nullptr || n_cells == nullptr) {
        fault.refuse(Status::bad_argument, "an argument is NULL");
        return tell(err, fault);
    }
    const Plan& p = *reinterpret_cast<const Plan*>(plan);
    p.level_cells(level, {cells, static_cast<Size>(p.mesh.n_points)}, *n_cells, fault);
    return tell(err, fault);
}

}  // extern "C"
