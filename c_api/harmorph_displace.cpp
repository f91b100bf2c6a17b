// The C interface: carries given displacements of wall points to the mesh, and the transpose; makes
// functions from tables of given displacements.
#include <type_traits>

#include "apart.hpp"
#include "given_list.hpp"
#include "limits.hpp"
#include "morph/displacement.hpp"

namespace harmorph {
namespace {

constexpr Limit<hm_modes> modes_limits[] = {
    {&hm_modes::numbers, 1, 2,
     "modes.numbers must be 1 (real values) or 2 (complex values), not #"},
    {&hm_modes::reserved, 0, 0, "modes.reserved must be 0, not #"},
};

constexpr Index max_fields = Index{1} << 20;

Status check_fields(Plan const& plan, Index n_fields, Fault& fault) noexcept {
    HARMORPH_TRY(require_given_points(plan, fault));
    if (n_fields >= 1 && n_fields <= max_fields) return Status::ok;
    return fault.refuse(Status::bad_argument, "n_fields must be between 1 and 2^20, not #",
                        plain(n_fields));
}

MutablePoints points_of(hm_points_out const& given) noexcept {
    return {given.x, given.y, stride_of(given.stride)};
}

// The plan, the list of wall points, and the working memory of hm_displace and hm_displace_adjoint.
struct DisplaceCall {
    Plan* plan = nullptr;
    PointList list;
    Displacement displacement;

    Status open(hm_plan* handle, Index n, const Index* points, Index n_fields, hm_memory* memory,
                const hm_solve_report* report, CallFault& fault) noexcept {
        HARMORPH_TRY(open_plan(handle, plan, fault));
        HARMORPH_TRY(check_fields(*plan, n_fields, fault));
        HARMORPH_TRY(place(memory, fault,
                           [&](Arena& arena) { displacement.lay_out(arena, *plan, n_fields); }));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        HARMORPH_TRY(view_given_list(*plan, n, points, list, fault));
        return displacement.find_places(*plan, list, fault);
    }

    template <class Given>
    static Status view_fields(const Given* given, Index n_fields, const char* name, Fault& fault,
                              Index n_points = 2) noexcept {
        HARMORPH_TRY(require({{name, given}}, fault));
        for (Index field = 0; field < n_fields; ++field) {
            View<Given> unused;
            HARMORPH_TRY(view_points(given + field, name, unused, fault, n_points));
        }
        return Status::ok;
    }

    // Checks the arrays of fields of n points that the call writes. Those of a single field may be
    // those of `from`, which is read again for each of several fields.
    Status check_apart(Points from, const char* name, const hm_points_out* to, Index n,
                       Fault& fault) const noexcept {
        if (displacement.n_fields == 1)
            return Apart::check_in_place("from", from, name, points_of(to[0]), n, fault);
        for (Index field = 0; field < displacement.n_fields; ++field) {
            Apart arrays;
            arrays.add("from", from, n);
            HARMORPH_TRY(arrays.check(name, points_of(to[field]), n, fault));
            for (Index other = 0; other < field; ++other) {
                Apart two;
                MutablePoints const before = points_of(to[other]);
                two.add(name, Points{before.x, before.y, before.stride}, n);
                HARMORPH_TRY(two.check(name, points_of(to[field]), n, fault));
            }
        }
        return Status::ok;
    }

    // Calls body(first field, views) for blocks of fields.
    template <class Given, class Body>
    static Status for_each_block(const Given* given, Index n_fields, Body const& body) noexcept {
        View<Given> views[GivenWall::fields_at_once];
        for (Index first = 0; first < n_fields; first += GivenWall::fields_at_once) {
            Index const n = min(n_fields - first, GivenWall::fields_at_once);
            for (Index i = 0; i < n; ++i)
                views[i] = {given[first + i].x, given[first + i].y,
                            stride_of(given[first + i].stride)};
            HARMORPH_TRY(body(first, Span<const View<Given>>{views, static_cast<Size>(n)}));
        }
        return Status::ok;
    }

    void write(SolveReport const& solved, hm_solve_report* report) const noexcept {
        if (report == nullptr) return;
        hm_solve_report filled = {};
        filled.unknowns = solved.unknowns;
        filled.functions = displacement.n_fields;
        filled.residual = solved.residual;
        filled.residual_function = solved.residual_function;
        filled.boundary_error_point = filled.max_distance_point = none;
        filled.refinements = solved.refinements;
        filled.factor_entries = solved.factor_entries;
        filled.iterations = solved.iteration.iterations;
        filled.levels = solved.iteration.levels;
        filled.work = solved.iteration.work;
        write_struct(filled, report);
    }

private:
    template <class Given>
    using View = std::conditional_t<std::is_same<Given, hm_points>::value, Points, MutablePoints>;
};

// The arguments that a size query and hm_tabulate have in common, and the layout of the block.
struct TableCall {
    Basis basis;
    hm_modes modes;

    // Handle is hm_plan and Object is Plan; either both are const or neither.
    template <class Handle, class Object>
    Status open(Handle* handle, Object*& plan, const hm_basis* given, const hm_modes* table,
                CallFault& fault) noexcept {
        HARMORPH_TRY(open_basis(given, basis, fault));
        if (basis.header->counts.functions() > 0) HARMORPH_TRY(open_complete(given, basis, fault));
        HARMORPH_TRY(open_plan(handle, plan, fault));
        HARMORPH_TRY(open_struct(table, modes, "modes", "hm_modes", fault));
        if (modes.numbers == 0) modes.numbers = 2;
        HARMORPH_TRY(check_fields(*plan, modes.n_modes, fault));
        HARMORPH_TRY(plan->check_fit(basis, fault));
        return check_limits(modes, modes_limits, fault);
    }
    // The new basis begins the block.
    void lay_out(Arena& arena, Plan const& plan, Basis& made, ModeWork& work) const noexcept {
        made.lay_out(arena, tabulated_counts(basis, modes.n_modes, modes.numbers));
        work.lay_out(arena, plan, 2 * plan.mesh().n_points, fields_of(basis, modes.n_modes));
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_given_points(const hm_plan* plan, int32_t* points, int32_t capacity, int32_t* n,
                          hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        const Plan* p = nullptr;
        HARMORPH_TRY(open_plan(plan, p, fault));
        HARMORPH_TRY(require({{"n", n}}, fault));
        if (capacity > 0) HARMORPH_TRY(require({{"points", points}}, fault));
        Span<const Index> const given = p->given().point;
        *n = given.count();
        if (capacity < *n) {
            return fault.refuse(
                Status::bad_argument,
                "points has room for # points, but @ points have given displacements",
                plain(capacity), plain(*n));
        }
        for (Index k = 0; k < *n; ++k) points[k] = given[k] + p->mesh().index_base;
        return Status::ok;
    });
}

hm_status hm_displace(hm_plan* plan, int32_t n, const int32_t* points, int32_t n_fields,
                      const hm_points* wall, const hm_points* from, const hm_points_out* to,
                      hm_memory* memory, hm_solve_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        DisplaceCall call;
        Points start;
        HARMORPH_TRY(call.open(plan, n, points, n_fields, memory, report, fault));
        HARMORPH_TRY(call.view_fields(wall, n_fields, "wall", fault, n));
        HARMORPH_TRY(view_points_if(from, "from", start, fault));
        HARMORPH_TRY(call.view_fields(to, n_fields, "to", fault));
        HARMORPH_TRY(call.check_apart(start, "to", to, call.plan->mesh().n_points, fault));
        Displacement const& displacement = call.displacement;
        displacement.clear(*call.plan);
        for (Index i = 0; i < n_fields; ++i) {
            HARMORPH_TRY(displacement.set(*call.plan, call.list, i, points_of(wall[i]), fault));
        }
        SolveReport solved;
        HARMORPH_TRY(displacement.solve(*call.plan, report != nullptr, solved, fault));
        for (Index i = 0; i < n_fields && start.given(); ++i) {
            HARMORPH_TRY(displacement.check_target(*call.plan, i, start, fault));
        }
        auto const write = [&](Index first, Span<const MutablePoints> fields) {
            displacement.write(*call.plan, first, start, fields);
            return Status::ok;
        };
        DisplaceCall::for_each_block(to, n_fields, write);
        call.write(solved, report);
        return fault.status;
    });
}

hm_status hm_displace_adjoint(hm_plan* plan, int32_t n, const int32_t* points, int32_t n_fields,
                              const hm_points* dj, const hm_points_out* gradient, hm_memory* memory,
                              hm_solve_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        DisplaceCall call;
        HARMORPH_TRY(call.open(plan, n, points, n_fields, memory, report, fault));
        HARMORPH_TRY(call.view_fields(dj, n_fields, "dj", fault));
        HARMORPH_TRY(call.view_fields(gradient, n_fields, "gradient", fault, n));
        HARMORPH_TRY(call.check_apart({}, "gradient", gradient, n, fault));
        Displacement const& displacement = call.displacement;
        HARMORPH_TRY(call.for_each_block(dj, n_fields, [&](Index first, Span<const Points> fields) {
            return displacement.set_derivatives(*call.plan, first, fields, fault);
        }));
        SolveReport solved;
        HARMORPH_TRY(displacement.solve_transposed(*call.plan, report != nullptr, solved, fault));
        for (Index i = 0; i < n_fields; ++i) {
            displacement.write_gradient(*call.plan, call.list, i, points_of(gradient[i]));
        }
        call.write(solved, report);
        return fault.status;
    });
}

hm_status hm_tabulate(hm_basis** tabulated, hm_memory* memory, hm_plan* plan, const hm_basis* basis,
                      const hm_modes* modes, hm_solve_report* report, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        TableCall table;
        DisplaceCall call;
        ModeWork work;
        Basis made;
        HARMORPH_TRY(table.open(plan, call.plan, basis, modes, fault));
        Plan& p = *call.plan;
        HARMORPH_TRY(
            place(memory, fault, [&](Arena& arena) { table.lay_out(arena, p, made, work); }));
        HARMORPH_TRY(
            require({{"tabulated", tabulated}, {"modes.values", table.modes.values}}, fault));
        HARMORPH_TRY(check_report_if(report, "report", fault));
        Index const n = table.modes.n;
        HARMORPH_TRY(view_given_list(*call.plan, n, table.modes.points, call.list, fault));
        if (n > 2 * call.plan->mesh().n_points) {
            return fault.refuse(
                Status::bad_argument,
                "n is #, but the list may have at most twice as many points as the mesh", plain(n));
        }
        bool const moved = table.basis.header->counts.functions() > 0 &&
                           table.basis.header->coordinates != p.coordinates();
        if (moved)
            return fault.refuse(Status::bad_basis,
                                "the basis was solved on other coordinates than those of the "
                                "plan's factor; solve the basis again");
        HARMORPH_TRY(work.displacement.find_places(p, call.list, fault));
        Modes const given{table.modes.n_modes, table.modes.numbers, table.modes.values};
        HARMORPH_TRY(given.check(n, fault));
        SolveReport solved;
        HARMORPH_TRY(tabulate(p, table.basis, call.list, given, work, made, solved, fault));
        *tabulated = reinterpret_cast<hm_basis*>(made.header);
        call.displacement.n_fields = table.modes.n_modes;
        call.write(solved, report);
        return fault.status;
    });
}

}  // extern "C"
