#include "work/task.hpp"

#include "basics/failure.hpp"
#include "basics/numbers.hpp"
#include "curves/curve_file.hpp"
#include "curves/section_movement.hpp"
#include "mesh/mesh_analysis.hpp"
#include "mesh/mesh_file.hpp"
#include "options/operators.hpp"
#include "work/engine.hpp"
#include "work/safe_way.hpp"

#include <harmorph_study.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <optional>
#include <string>

namespace cli {

namespace {

// Returns the exponent as the library expects it: 0 for the default, -1 for no weight.
double exponent_of(const Arguments& arguments) {
    if (!arguments.has("--exponent")) return 0;
    double exponent = 0;
    const bool is_number = parse(arguments.text("--exponent"), exponent);
    if (!is_number || !(exponent >= 0 && exponent <= 4) || std::fmod(exponent, 0.25) != 0) {
        arguments.refuse("--exponent expects a number from 0 to 4 in steps of 1/4, not " +
                         in_quotes(arguments.text("--exponent")));
    }
    return exponent == 0 ? -1 : exponent;
}

}  // namespace

bool Task::slips() const {
    return std::any_of(conditions.begin(), conditions.end(),
                       [](const hm_condition& condition) { return condition.kind == HM_SLIP; });
}

Task task_of(const Arguments& arguments, const Mesh& mesh) {
    Task task;
    task.options.tolerance = arguments.positive("--tol", 1e-10);
    task.options.operator_kind =
        compares_operators(arguments) ? HM_CONFORMAL : operator_of(arguments);
    task.options.exponent = exponent_of(arguments);
    task.options.scheme =
        arguments.choice("--scheme", {{"compact", HM_COMPACT},
                                      {"nodal-gradient", HM_NODAL_GRADIENT},
                                      {"nodal-gradient-plain", HM_NODAL_GRADIENT_PLAIN},
                                      {"bounded", HM_BOUNDED}});
    task.options.offset_correction = arguments.has("--offset-correction") ? 1 : 0;
    set_engine(arguments, task);
    constexpr double farthest = 0.01;
    task.max_curve_distance = arguments.has("--far-from-curve") ? 1e100 : farthest;
    add_conditions(arguments, mesh, task);
    return task;
}

Task task_of(const Basis& basis) {
    Task task;
    const hm_basis_info& info = basis.info();
    task.options.operator_kind = info.operator_kind;
    task.options.scheme = info.scheme;
    task.options.engine = info.engine;
    task.options.exponent = info.exponent == 0 ? -1 : info.exponent;
    task.options.offset_correction = info.offset_correction;
    task.conditions = basis.conditions();
    task.slip_curves = basis.slip_curves();
    task.curves =
        copied(basis.why_on_no_curve().empty() ? basis.curves() : basis.curves_at_start());
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        if (info.point_curve[k] >= info.curves) continue;  // the point is on no curve
        task.known_points.push_back(info.curve_point[k]);
        task.known_curves.push_back(info.point_curve[k]);
        task.known_u.push_back(info.point_u[k]);
    }
    return task;
}

// The conditions of a task, as the command line gives them.

namespace {

// Finds the translation or rotation that maps one side of a pair of --periodic onto the other.

// A translation is tried first (HM_PERIODIC_PAIR), then a rotation about the origin, then a
// rotation about the centre that fits best (HM_ROTATION_PAIR). If no map fits, the condition is
// that of a translation, which the library refuses with the place of the misfit.
struct SidePair {
    hm_condition condition;
    std::string
        passage;  // "'left' to 'right' turned by 40 degrees about (0, 0)"; empty for translates
};

using Complex = std::complex<double>;

constexpr double max_relative_misfit = 1e-6;  // of the extent, as in the library

struct Sides {
    std::vector<Complex> from, to;  // points that are images of each other, in order

    double misfit(Complex turn, Complex shift) const {
        double worst = 0;
        for (std::size_t k = 0; k < from.size(); ++k)
            worst = std::max(worst, std::abs(to[k] - turn * from[k] - shift));
        return worst;
    }
    bool fit(Complex turn, Complex shift) const {
        double extent = 0;
        for (std::size_t k = 0; k < from.size(); ++k) {
            extent = std::max({extent, std::abs(from[k] - from[0]), std::abs(to[k] - from[k])});
        }
        return misfit(turn, shift) <= max_relative_misfit * extent;
    }
    Complex mean(const std::vector<Complex>& side) const {
        Complex sum = 0;
        for (const Complex z : side) sum += z;
        return sum / static_cast<double>(side.size());
    }
    // Returns the rotation that maps `from` - a to `to` - b best in the least-squares sense.
    Complex turn_about(Complex a, Complex b) const {
        Complex sum = 0;
        for (std::size_t k = 0; k < from.size(); ++k) sum += std::conj(from[k] - a) * (to[k] - b);
        return std::abs(sum) > 0 ? sum / std::abs(sum) : Complex(1);
    }
};

// Returns nothing if one of the markers is not one open piece, or if their numbers of points
// differ.
std::optional<Sides> sides_of(const Mesh& mesh, std::int32_t marker, std::int32_t partner) {
    try {
        const MeshAnalysis analysis(mesh);
        const BoundaryPiece a = analysis.boundary({marker}), b = analysis.boundary({partner});
        if (a.is_loop || b.is_loop || a.points.size() != b.points.size()) return {};
        Sides sides;
        const auto place = [&mesh](std::int32_t point) {
            return Complex(mesh.x[static_cast<std::size_t>(point)],
                           mesh.y[static_cast<std::size_t>(point)]);
        };
        // Both pieces have the mesh on their left, so they run in opposite directions.
        for (std::size_t k = 0; k < a.points.size(); ++k) {
            sides.from.push_back(place(a.points[k]));
            sides.to.push_back(place(b.points[b.points.size() - 1 - k]));
        }
        return sides;
    } catch (const Failure&) {  // the library refuses the markers when the problem is solved
        return {};
    }
}

SidePair side_pair(const Mesh& mesh, std::int32_t marker, std::int32_t partner) {
    SidePair out{sized<hm_condition>(), {}};
    hm_condition& pair = out.condition;
    pair.marker = marker;
    pair.partner = partner;
    pair.kind = HM_PERIODIC_PAIR;
    const std::optional<Sides> sides = sides_of(mesh, marker, partner);
    if (!sides) return out;
    const Complex from = sides->mean(sides->from), to = sides->mean(sides->to);
    if (sides->fit(1, to - from)) return out;
    Complex turn = sides->turn_about(0, 0), centre = 0;
    if (!sides->fit(turn, 0)) {
        turn = sides->turn_about(from, to);
        centre = (to - turn * from) / (1.0 - turn);
        if (!sides->fit(turn, centre - turn * centre)) return out;
    }
    pair.kind = HM_ROTATION_PAIR;
    pair.x = centre.real();
    pair.y = centre.imag();
    out.passage = "'" + mesh.markers[static_cast<std::size_t>(marker)] + "' to '" +
                  mesh.markers[static_cast<std::size_t>(partner)] + "' turned by " +
                  brief(180 / pi * std::arg(turn)) + " degrees about (" + brief(pair.x) + ", " +
                  brief(pair.y) + ")";
    return out;
}

hm_condition condition_on(std::int32_t marker, std::int32_t kind) {
    auto condition = sized<hm_condition>();
    condition.marker = marker;
    condition.kind = kind;
    return condition;
}

hm_condition condition_on(const MarkerPiece& on, std::int32_t kind) {
    hm_condition condition = condition_on(on.marker, kind);
    condition.piece = on.is_piece ? 1 : 0;
    condition.near_x = on.x;
    condition.near_y = on.y;
    return condition;
}

void add_condition(const Arguments& arguments, const Mesh& mesh, Task& task,
                   const hm_condition& condition) {
    for (const hm_condition& other : task.conditions) {
        if (other.marker == condition.marker && other.piece == 0 && condition.piece == 0 &&
            other.kind != HM_INTERFACE) {
            arguments.refuse("marker " +
                             in_quotes(mesh.markers[static_cast<std::size_t>(condition.marker)]) +
                             " has two conditions; name the marker once");
        }
    }
    task.conditions.push_back(condition);
}

// binding: "A[,B..]=FILE"; these markers lie on the curves of that file.
void put_on_curves(const Arguments& arguments, const Mesh& mesh, Task& task,
                   const std::string& binding) {
    const auto [markers, file] = mesh.split_binding(binding);
    if (file.empty()) arguments.refuse("--curve expects MARKER=FILE, not " + in_quotes(binding));
    const auto first_curve = static_cast<std::int32_t>(task.curves.curves.size());
    task.curves.append(read_curves(file));
    for (const MarkerPiece& piece : mesh.find_pieces(markers)) {
        hm_condition condition = condition_on(piece, HM_ON_CURVE);
        condition.first_curve = first_curve;
        condition.n_curves = static_cast<std::int32_t>(task.curves.curves.size()) - first_curve;
        add_condition(arguments, mesh, task, condition);
    }
}

// binding: "A[,B..]" or "A[,B..]=FILE"; the points of these markers slip, along the curves of that
// file if there is one.
void let_slip(const Arguments& arguments, const Mesh& mesh, Task& task,
              const std::string& binding) {
    const auto [markers, file] = mesh.split_binding(binding);
    hm_condition along = condition_on(0, HM_SLIP);
    if (markers.size() < binding.size()) {
        task.slip_curves.push_back(std::make_shared<const CurveSet>(read_curves(file)));
        along.along = task.slip_curves.back()->view.get();
        along.n_curves = along.along->n_curves;
    }
    for (const MarkerPiece& piece : mesh.find_pieces(markers)) {
        hm_condition condition = condition_on(piece, HM_SLIP);
        condition.along = along.along;
        condition.n_curves = along.n_curves;
        add_condition(arguments, mesh, task, condition);
    }
}

// Finds the centre of the smallest box that contains the points of the markers; for pieces, the
// point X:Y that selects the first piece.
void centre_of(const Mesh& mesh, const std::vector<MarkerPiece>& pieces, double& x, double& y) {
    std::vector<std::int32_t> markers;
    for (const MarkerPiece& piece : pieces) {
        markers.push_back(piece.marker);
        if (!piece.is_piece) continue;
        x = piece.x;
        y = piece.y;
        return;
    }
    double low[2] = {0, 0}, high[2] = {0, 0};
    bool first = true;
    for (std::int32_t face = 0; face < mesh.faces(); ++face) {
        const auto at_face = static_cast<std::size_t>(face);
        if (std::find(markers.begin(), markers.end(), mesh.face_markers[at_face]) == markers.end())
            continue;
        for (std::size_t end = 2 * at_face; end < 2 * at_face + 2; ++end) {
            const auto point = static_cast<std::size_t>(mesh.face_points[end]);
            const double at[2] = {mesh.x[point], mesh.y[point]};
            for (std::size_t i = 0; i < 2; ++i) {
                low[i] = first ? at[i] : std::min(low[i], at[i]);
                high[i] = first ? at[i] : std::max(high[i], at[i]);
            }
            first = false;
        }
    }
    x = .5 * (low[0] + high[0]);
    y = .5 * (low[1] + high[1]);
}

// binding: "A[,B..]" or "A[,B..]=X,Y", the markers of one body and its centre of rotation.
void make_rigid(const Arguments& arguments, const Mesh& mesh, Task& task,
                const std::string& binding, std::int32_t body) {
    const auto [markers, centre] = mesh.split_binding(binding);
    const std::vector<MarkerPiece> pieces = mesh.find_pieces(markers);
    double x = 0, y = 0;
    centre_of(mesh, pieces, x, y);
    if (markers.size() < binding.size() && !parse_place(centre, x, y))
        arguments.refuse("--rigid expects MARKER or MARKER=X,Y, not " + in_quotes(binding));
    for (const MarkerPiece& piece : pieces) {
        hm_condition condition = condition_on(piece, HM_RIGID);
        condition.body = body;
        condition.x = x;
        condition.y = y;
        add_condition(arguments, mesh, task, condition);
    }
}

// Returns the markers that a name or a pattern stands for; none if the mesh has no such marker.
std::vector<std::int32_t> markers_called(const Mesh& mesh, const std::string& name) {
    try {
        return mesh.find_markers(name);
    } catch (const Failure&) {
        return {};
    }
}

// Returns the two markers of "A:B", two names or patterns that stand for one marker each. Names may
// contain colons.
std::pair<std::int32_t, std::int32_t> marker_pair(const Arguments& arguments, const Mesh& mesh,
                                                  const std::string& option,
                                                  const std::string& binding) {
    for (std::size_t colon = binding.find(':'); colon != std::string::npos;
         colon = binding.find(':', colon + 1)) {
        const std::vector<std::int32_t> one = markers_called(mesh, binding.substr(0, colon)),
                                        other = markers_called(mesh, binding.substr(colon + 1));
        if (one.size() == 1 && other.size() == 1) return {one[0], other[0]};
    }
    arguments.refuse(option +
                     " expects two names of the mesh as A:B, each of which stands for one marker, "
                     "not " +
                     in_quotes(binding));
}

void make_periodic(const Arguments& arguments, const Mesh& mesh, Task& task,
                   const std::string& binding) {
    const auto [marker, partner] = marker_pair(arguments, mesh, "--periodic", binding);
    const SidePair pair = side_pair(mesh, marker, partner);
    if (!pair.passage.empty()) task.passages.push_back(pair.passage);
    add_condition(arguments, mesh, task, pair.condition);
}

// Returns -1 if the mesh has no marker of this tag.
std::int32_t marker_of(const Mesh& mesh, const std::string& tag) {
    const auto found = std::find(mesh.markers.begin(), mesh.markers.end(), tag);
    if (found == mesh.markers.end()) return -1;
    return static_cast<std::int32_t>(std::distance(mesh.markers.begin(), found));
}

// Adds the interfaces of the options and those that the mesh file names.
void add_interfaces(const Arguments& arguments, const Mesh& mesh, Task& task) {
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
    const auto is_known = [&pairs](std::int32_t one, std::int32_t other) {
        for (const auto& [first, second] : pairs) {
            if ((first == one && second == other) || (first == other && second == one)) return true;
        }
        return false;
    };
    for (const std::string& binding : arguments.all("--interface"))
        pairs.push_back(marker_pair(arguments, mesh, "--interface", binding));
    for (const auto& [one, other] : mesh.interfaces) {
        const std::int32_t marker = marker_of(mesh, one), partner = marker_of(mesh, other);
        if (marker >= 0 && partner >= 0 && !is_known(marker, partner))
            pairs.emplace_back(marker, partner);
    }
    for (const auto& [marker, partner] : pairs) {
        hm_condition condition = condition_on(marker, HM_INTERFACE);
        condition.partner = partner;
        task.conditions.push_back(condition);
    }
}

// Conditions that are given by markers alone.
constexpr struct {
    const char* option;
    std::int32_t kind;
} plain_conditions[] = {{"--given", HM_GIVEN}, {"--free", HM_FREE}};

}  // namespace

void add_conditions(const Arguments& arguments, const Mesh& mesh, Task& task) {
    for (const std::string& binding : arguments.all("--curve"))
        put_on_curves(arguments, mesh, task, binding);
    std::int32_t body = 0;
    for (const std::string& binding : arguments.all("--rigid"))
        make_rigid(arguments, mesh, task, binding, body++);
    for (const std::string& binding : arguments.all("--periodic"))
        make_periodic(arguments, mesh, task, binding);
    for (const auto& plain : plain_conditions) {
        for (const std::string& tags : arguments.all(plain.option)) {
            for (const MarkerPiece& piece : mesh.find_pieces(tags)) {
                add_condition(arguments, mesh, task, condition_on(piece, plain.kind));
            }
        }
    }
    for (const std::string& binding : arguments.all("--slip"))
        let_slip(arguments, mesh, task, binding);
    add_interfaces(arguments, mesh, task);
    if (!arguments.has("--flux")) return;
    const auto n_control = static_cast<std::int32_t>(task.curves.control.size() / 2);
    if (n_control == 0) arguments.refuse("--flux is for functions of control points; give --curve");
    task.fluxes = read_fluxes(arguments.text("--flux"), mesh, n_control);
}

}  // namespace cli
