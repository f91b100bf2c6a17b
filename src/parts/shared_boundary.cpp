#include "parts/shared_boundary.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

bool edge_comes_before(OpenEdge const& a, OpenEdge const& b) noexcept {
    if (a.low() != b.low()) return a.low() < b.low();
    if (a.high() != b.high()) return a.high() < b.high();
    if (a.begin != b.begin) return a.begin < b.begin;
    return a.marker != b.marker ? a.marker < b.marker : a.marked < b.marked;
}

bool same_place(Vec2 a, Vec2 b) noexcept { return a.x == b.x && a.y == b.y; }

Status refuse_position(Offset number, Fault& fault) noexcept {
    return fault.refuse(Status::bad_mesh,
                        "the point with global number # has different coordinates in two parts",
                        global_point_item(number));
}

// Checks two edges with the same ends.
Status check_pair(OpenEdge const& a, OpenEdge const& b, Fault& fault) noexcept {
    bool const opposite = a.begin == b.end;
    Vec2 const begin = opposite ? b.at_end : b.at_begin, end = opposite ? b.at_begin : b.at_end;
    if (!same_place(a.at_begin, begin)) return refuse_position(a.begin, fault);
    if (!same_place(a.at_end, end)) return refuse_position(a.end, fault);
    const char* wrong = nullptr;
    if (!opposite) {
        wrong =
            "cells of two parts overlap at the edge between the points with global numbers # and @";
    } else if (a.marked != 0 || b.marked != 0) {
        wrong =
            "the edge between the points with global numbers # and @ has a marker, but two parts "
            "have a cell at this edge";
    }
    if (wrong == nullptr) return Status::ok;
    return fault.refuse(Status::bad_mesh, wrong, global_point_item(a.begin),
                        global_point_item(a.end));
}

}  // namespace

Status match_edges(Span<OpenEdge> edges, Offset& n, Fault& fault) noexcept {
    sort(edges, edge_comes_before);
    Offset const count = static_cast<Offset>(edges.size());
    n = 0;
    for (Offset k = 0, next; k < count; k = next) {
        OpenEdge const edge = edges[k];
        auto const has_same_ends = [&](OpenEdge const& other) {
            return other.low() == edge.low() && other.high() == edge.high();
        };
        for (next = k + 1; next < count && has_same_ends(edges[next]);) ++next;
        if (next == k + 1) {
            edges[n++] = edge;
            continue;
        }
        for (Offset other = k + 1; other < next; ++other)
            HARMORPH_TRY(check_pair(edge, edges[other], fault));
        if (next == k + 2) continue;
        return fault.refuse(Status::bad_mesh,
                            "the edge between the points with global numbers # and @ belongs to "
                            "more than two cells",
                            global_point_item(edge.begin), global_point_item(edge.end));
    }
    return Status::ok;
}

Mesh SharedBoundary::mesh() const noexcept {
    Mesh counts;
    counts.n_points = n_points;
    counts.n_faces = edges.count();
    counts.points = points();
    return counts;
}

void SharedBoundary::lay_out(Arena& arena, Index n_edges, PartProblem const& problem,
                             Index n_curves, Index n_conditions) noexcept {
    Mesh counts;
    counts.n_points = 2 * n_edges;  // This is the largest possible number.
    counts.n_faces = n_edges;
    arena.take(curves, n_curves);
    arena.take(conditions, n_conditions);
    arena.take(edges, n_edges);
    arena.take(number, counts.n_points);
    arena.take(x, counts.n_points);
    arena.take(y, counts.n_points);
    arena.take(topology.reversed, 1);
    arena.take(topology.edges.start, Offset{counts.n_points} + 1);
    arena.take(topology.edges.first, n_edges);
    arena.take(topology.edges.second, n_edges);
    arena.take(topology.representative, counts.n_points);
    boundary.lay_out(arena, counts);
    arena.take(kinds, counts.n_points);
    arena.take(tangent, problem.demands.slip ? counts.n_points : 0);
    if (problem.demands.slip) slip_curves.lay_out(arena, static_cast<Size>(n_edges), false);
    wall.lay_out(arena, counts);
    wall_work.lay_out(arena, counts);
}

Status SharedBoundary::run(Span<const OpenEdge> given, PartProblem const& problem,
                           Fault& fault) noexcept {
    copy(edges, given);
    sort(edges, edge_comes_before);
    HARMORPH_TRY(find_points(fault));
    analyse(problem, fault);
    Item* const items[] = {&fault.item, &fault.other};
    for (Item* const named : items) {
        if (named->kind == ItemKind::point) *named = global_point_item(number[named->number]);
    }
    return fault.status;
}

// Collects the ends of all edges, once each.
Status SharedBoundary::find_points(Fault& fault) noexcept {
    Size n = 0;
    for (OpenEdge const& edge : edges) {
        number[n++] = edge.begin;
        number[n++] = edge.end;
    }
    sort(number.first(n), [](Offset a, Offset b) { return a < b; });
    n_points = 0;
    for (Size k = 0; k < n; ++k) {
        if (k == 0 || number[k] != number[k - 1]) number[n_points++] = number[k];
    }
    number = number.first(n_points);
    x = x.first(n_points);
    y = y.first(n_points);
    kinds = kinds.first(n_points);
    if (!tangent.empty()) tangent = tangent.first(n_points);
    topology.representative = topology.representative.first(n_points);
    topology.edges.start = topology.edges.start.first(Offset{n_points} + 1);
    wall_work.slot = wall_work.slot.first(n_points);
    // In this function, the value tells whether the point has coordinates already.
    Span<Index> const seen = topology.representative;
    fill(seen, Index{0});
    auto const place = [&](Offset named, Vec2 at) {
        Index const point = find(named);
        if (seen[point] != 0 && !same_place(at, {x[point], y[point]}))
            return refuse_position(named, fault);
        seen[point] = 1;
        x[point] = at.x;
        y[point] = at.y;
        return Status::ok;
    };
    for (OpenEdge const& edge : edges) {
        HARMORPH_TRY(place(edge.begin, edge.at_begin));
        HARMORPH_TRY(place(edge.end, edge.at_end));
    }
    for (Index k = 0; k < n_points; ++k) topology.representative[k] = k;
    topology.mesh = mesh();
    topology.reversed[0] = 0;
    return Status::ok;
}

// Takes the edges between representatives, and their markers, in the form in which Edges::build and
// Boundary::mark leave them. If a cut joins two edges to one, both are dropped.
void SharedBoundary::take_edges(Fault& fault) noexcept {
    Edges& sides = topology.edges;
    Span<const Index> const same = topology.representative;
    struct Ends {
        Index begin, end;
        Index low() const noexcept { return min(begin, end); }
        Index high() const noexcept { return max(begin, end); }
    };
    auto const ends_of = [&](OpenEdge const& edge) {
        return Ends{same[find(edge.begin)], same[find(edge.end)]};
    };
    sort(edges, [&](OpenEdge const& a, OpenEdge const& b) {
        Ends const p = ends_of(a), q = ends_of(b);
        if (p.low() != q.low()) return p.low() < q.low();
        if (p.high() != q.high()) return p.high() < q.high();
        return a.marked != b.marked ? a.marked < b.marked : edge_comes_before(a, b);
    });
    fill(sides.start, Index{0});
    boundary.count = 0;
    Index n = 0;
    for (Index k = 0; k < edges.count(); ++k) {
        OpenEdge const& edge = edges[k];
        Ends const at = ends_of(edge);
        if (k + 1 < edges.count() && edge.marked == 0 && edges[k + 1].marked == 0) {
            Ends const next = ends_of(edges[k + 1]);
            if (next.begin == at.end && next.end == at.begin && at.begin != at.end) {
                ++k;
                continue;
            }
        }
        if (at.begin == at.end) {
            fault.refuse(Status::bad_mesh,
                         "a cut joins both ends of the edge between points # and @",
                         point_item(find(edge.begin)), point_item(find(edge.end)));
            return;
        }
        sides.first[n] = {at.high(), at.begin < at.end ? 0 : 1};
        sides.second[n] = Edges::unmarked;
        if (edge.marked != 0) {
            boundary.given_marker[boundary.count] = edge.marker;
            boundary.given_begin[boundary.count] = n;
            boundary.given_end[boundary.count] = at.low();
            sides.second[n] = -2 - boundary.count++;
        }
        ++sides.start[at.low()];
        ++n;
    }
    counts_to_starts(sides.start);
    sides.n_boundary = n;
}

Status SharedBoundary::find_boundary(Fault& fault) noexcept {
    take_edges(fault);
    HARMORPH_TRY(fault.status);
    HARMORPH_TRY(join_cuts(topology, boundary, fault, [&] { take_edges(fault); }));
    return boundary.order(topology, fault);
}

Status SharedBoundary::analyse(PartProblem const& problem, Fault& fault) noexcept {
    HARMORPH_TRY(find_boundary(fault));
    assign_conditions(points(), conditions, boundary);
    classify(topology.edges, boundary, conditions, kinds);
    for (Index k = 0; k < n_points; ++k) {  // These points are only on a cut.
        if (topology.representative[k] == k && kinds[k] == PointKind::unused)
            kinds[k] = PointKind::inside;
    }
    for (Index k = 0; k < curves.count(); ++k) {
        HARMORPH_TRY(check_curve(curves[k], k, fault));
    }
    HARMORPH_TRY(check_conditions(conditions, curves.count(), boundary, fault));
    HARMORPH_TRY(parametrise(topology, boundary, conditions, curves, {}, problem.max_curve_distance,
                             wall_work, wall, fault));
    find_offsets(points(), conditions, curves, problem.method.offset_correction != 0, wall);
    find_shared(boundary, conditions, curves, wall_work.slot, wall, fault);
    if (problem.demands.slip) {
        HARMORPH_TRY(find_slip_lines(points(), boundary, conditions, {{}, wall_work}, kinds,
                                     tangent, slip_curves, fault));
    }
    if (!problem.demands.translation) return fault.status;
    return tie_periodic(topology, boundary, conditions, wall_work.chain_point, kinds, tangent,
                        periodicity, fault);
}

Index SharedBoundary::find(Offset wanted) const noexcept {
    Index low = 0, high = n_points;
    while (low < high) {
        Index const middle = low + (high - low) / 2;
        if (number[middle] < wanted) low = middle + 1;
        else high = middle;
    }
    return low < n_points && number[low] == wanted ? low : none;
}

bool SharedBoundary::is_wall_face(Index face) const noexcept {
    const Condition* const condition = condition_of(conditions, boundary, face);
    return condition != nullptr && condition->is_wall();
}

Index SharedBoundary::count_wall_faces() const noexcept {
    Index n = 0;
    for (Index face = 0; face < boundary.count; ++face) n += is_wall_face(face) ? 1 : 0;
    return n;
}

}  // namespace harmorph
