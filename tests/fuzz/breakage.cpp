#include <harmorph_study.h>
#include "fixtures/memory.hpp"
#include "problem.hpp"

#include <algorithm>

namespace fuzz {
namespace {

template <class Number>
Number& some(std::vector<Number>& from, Input& input) {
    return from[input.below(static_cast<std::uint32_t>(from.size()))];
}
template <class Struct>
void shorten(Struct& fields, Input& input) {
    fields.struct_size =
        input.any_of<std::uint64_t>({0, 7, 8, sizeof fields - 8, sizeof fields - 1});
}

void shorten(Options& all, Input& input) {
    hm_options& options = all;
    hm_study_options& study = all;
    if (input.one_in(2)) shorten(options, input);
    else shorten(study, input);
}

void break_points(Problem& problem, Input& input) {
    double& number = some(problem.coordinates, input);
    switch (input.below(4)) {
        case 0: number = input.wild(); break;
        case 1:
            number = some(problem.coordinates, input);
            break;  // points in one place, cells without area
        case 2: number += input.between(-3, 3) * problem.size() / 10; break;  // inverted cells
        default:
            for (double& each : problem.coordinates)
                each *= input.any_of({1e-200, 1e-90, 1e95, 1e200, 0.0});
    }
}
void break_indices(Problem& problem, Input& input) {
    std::vector<std::int32_t>* const arrays[] = {
        &problem.cells, &problem.quads,      &problem.cell_start,   &problem.faces,
        &problem.lists, &problem.list_start, &problem.face_markers, &problem.list_markers};
    std::vector<std::int32_t>& array = *arrays[input.below(8)];
    if (array.empty()) return;
    std::int32_t& index = some(array, input);
    std::int32_t const old = index;
    index = input.one_in(2) ? input.wild_index() : some(array, input);
    // The library does not know the lengths of cell_points and list_points: the last row of points
    // must not end behind the array.
    bool const are_rows = &array == &problem.cell_start || &array == &problem.list_start;
    if (are_rows && &index == &array.back()) index = std::min(index, old);
}
void break_counts(Problem& problem, Input& input) {
    hm_mesh& mesh = problem.mesh;
    std::int32_t* const counts[] = {&mesh.n_points, &mesh.n_cells, &mesh.n_faces, &mesh.n_lists,
                                    &mesh.n_quads,  &mesh.ni,      &mesh.nj};
    std::int32_t& count = *counts[input.below(7)];
    std::int32_t const old = count;
    if (input.one_in(2)) count = -input.from(0, 3);
    else count = old - std::min(old, input.from(1, 3));
    // A mixed mesh with fewer quadrilaterals and as many cells would need more triangles than the
    // array has.
    if (&count == &mesh.n_quads && count >= 0) mesh.n_cells -= old - count;
    if (input.one_in(4)) mesh.index_base = input.any_of({-1, 2, 1 - mesh.index_base});
    if (input.one_in(4)) mesh.cell_layout = input.any_of({-1, 5, 1000});
}
void break_pointers(Problem& problem, Input& input) {
    switch (input.below(10)) {
        case 0: problem.mesh.points.x = nullptr; break;
        case 1: problem.mesh.points.y = nullptr; break;
        case 2: problem.mesh.cell_points = nullptr; break;
        case 3: problem.mesh.cell_start = nullptr; break;
        case 4: problem.mesh.face_points = nullptr; break;
        case 5: problem.mesh.list_start = nullptr; break;
        case 6: problem.problem.mesh = nullptr; break;
        case 7: problem.problem.conditions = nullptr; break;
        case 8: problem.on_walls.view.control = nullptr; break;
        default: problem.mesh.points.stride = -1;
    }
}
void break_curves(Problem& problem, Input& input) {
    CurveArrays& along = problem.along[problem.along[0].curve.empty() ? 1 : 0];
    CurveArrays& set = !along.curve.empty() && input.one_in(2) ? along : problem.on_walls;
    if (set.curve.empty()) return;
    hm_curve& curve = some(set.curve, input);
    std::size_t const c = at(&curve - set.curve.data());
    switch (input.below(8)) {
        case 0: some(set.control, input) = input.wild(); break;
        case 1: some(set.control, input) *= 1e3; break;
        case 2: some(set.knots[c], input) = input.wild(); break;
        case 3: some(set.knots[c], input) = some(set.knots[c], input); break;
        case 4: some(set.indices[c], input) = input.wild_index(); break;
        case 5: some(set.indices[c], input) = some(set.indices[c], input); break;
        case 6: curve.n_indices = std::min(curve.n_indices, input.from(-1, 3)); break;
        case 7:
            set.weights.assign(at(set.view.n_control), 1.0);
            some(set.weights, input) = input.one_in(2) ? input.wild() : -1;
            set.view.weights = set.weights.data();
            break;
        default: set.view.n_control -= input.from(1, 3);
    }
}
void break_conditions(Problem& problem, Input& input) {
    if (problem.conditions.empty()) return;
    hm_condition& condition = some(problem.conditions, input);
    switch (input.below(8)) {
        case 0: condition.marker = input.wild_index(); break;
        case 1: condition.kind = input.from(-1, 8); break;
        case 2: condition.first_curve = input.wild_index(); break;
        case 3: condition.n_curves = input.wild_index(); break;
        case 4: condition.body = input.wild_index(); break;
        case 5: condition.partner = input.wild_index(); break;
        case 6:
            if (condition.kind == HM_SLIP)
                condition.along = condition.along == nullptr ? &problem.on_walls.view : nullptr;
            else condition.x = input.wild();
            break;
        default:
            problem.conditions.push_back(condition),
                problem.problem.conditions = problem.conditions.data(),
                ++problem.problem.n_conditions;
    }
}
void break_options(Problem& problem, Input& input) {
    Options& o = problem.options;
    std::int32_t* const numbers[] = {&o.operator_kind,     &o.scheme, &o.engine,
                                     &o.offset_correction, &o.levels, &o.agglomeration,
                                     &o.block_width,       &o.start};
    if (input.one_in(10)) o.exponent = input.wild();
    *numbers[input.below(8)] = input.one_in(2) ? input.wild_index() : input.from(-2, 6);
    if (input.one_in(4)) o.tolerance = input.wild();
}
void break_given(Problem& problem, Input& input) {
    for (std::int32_t k = input.from(1, 3); k > 0; --k) {
        problem.known_points.push_back(input.one_in(4) ? input.wild_index()
                                                       : input.from(0, problem.mesh.n_points));
        problem.known_curves.push_back(input.one_in(4) ? input.wild_index() : 0);
        problem.known_u.push_back(input.one_in(4) ? input.wild() : input.between(0, 1));
    }
    problem.problem.n_known = static_cast<std::int32_t>(problem.known_u.size());
    problem.problem.known_points = problem.known_points.data();
    problem.problem.known_curves = problem.known_curves.data();
    problem.problem.known_u = problem.known_u.data();
}

}  // namespace

void break_something(Problem& problem, Input& input) {
    switch (input.below(8)) {
        case 0: return break_points(problem, input);
        case 1: return break_indices(problem, input);
        case 2: return break_counts(problem, input);
        case 3: return break_pointers(problem, input);
        case 4: return break_curves(problem, input);
        case 5: return break_conditions(problem, input);
        case 6: return break_options(problem, input);
        case 7: return break_given(problem, input);
        default: break;
    }
    switch (input.below(5)) {
        case 0: return shorten(problem.mesh, input);
        case 1: return shorten(problem.on_walls.view, input);
        case 2: return shorten(problem.problem, input);
        case 3: return shorten(problem.options, input);
        default:
            if (!problem.conditions.empty()) shorten(problem.conditions[0], input);
    }
}

}  // namespace fuzz
