#include "page/explore_data.hpp"

#include "basics/json.hpp"
#include "files/paths.hpp"
#include "files/threads.hpp"
#include "options/operators.hpp"
#include "page/numbers_as_text.hpp"
#include "work/solver.hpp"
#include "work/task.hpp"

#include <harmorph_study.h>

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

// The largest difference of functions between a basis and its page [-].
constexpr double max_difference = 1e-9;

JsonObject json_of(const hm_curve& curve, std::int32_t index_base) {
    std::vector<std::int32_t> indices;
    for (std::int32_t k = 0; k < curve.n_indices; ++k)
        indices.push_back(curve.indices == nullptr ? k : curve.indices[k] - index_base);
    const auto n_knots = static_cast<std::size_t>(curve.n_indices + curve.degree + 1);
    JsonObject object;
    object.add("degree", curve.degree).add("indices", numbers_as_text(indices));
    object.add("knots", numbers_as_text(curve.knots, n_knots));
    return object;
}

JsonObject json_of(const hm_curves& curves) {
    const auto n = static_cast<std::size_t>(curves.n_control);
    const bool is_rational = curves.weights != nullptr;
    std::vector<JsonObject> list;
    for (std::int32_t i = 0; i < curves.n_curves && n > 0; ++i)
        list.push_back(json_of(curves.curve[i], curves.index_base));
    JsonObject object;
    object.add("control", numbers_as_text(curves.control, 2 * n))
        .add("weights", is_rational ? numbers_as_text(curves.weights, n) : std::string())
        .add("curves", list);
    return object;
}

class ExploreWriter {
public:
    ExploreWriter(const Mesh& mesh, const Basis& basis) : mesh_(mesh), basis_(basis) {}

    JsonObject& run() {
        const hm_basis_info& info = basis_.info();
        object_.add("version", std::string(hm_version()));
        object_.add("mesh", last_name(mesh_.file.path()));
        object_.add("operator", std::string(operator_named(info.operator_kind).functions));
        object_.add("operator_kind", info.operator_kind).add("exponent", info.exponent);
        object_.add("offset_correction", info.offset_correction != 0);
        add_mesh();
        object_.add("curves", std::vector<JsonObject>{json_of(basis_.curves())});
        add_conditions();
        return object_;
    }

private:
    void add_mesh() {
        object_.add("x", numbers_as_text(mesh_.x)).add("y", numbers_as_text(mesh_.y));
        object_.add("cell_start", numbers_as_text(mesh_.cell_start));
        object_.add("cell_points", numbers_as_text(mesh_.cell_points));
        object_.add("has_polygons", mesh_.has_polygons);
        object_.add("face_points", numbers_as_text(mesh_.face_points));
        object_.add("face_markers", numbers_as_text(mesh_.face_markers));
        std::vector<JsonObject> markers;
        for (const std::string& name : mesh_.markers) markers.emplace_back().add("name", name);
        object_.add("markers", markers);
    }

    void add_conditions() {
        static const char* const kinds[] = {"curve",    "rigid", "fixed",    "slip",     "free",
                                            "periodic", "given", "rotation", "interface"};
        std::vector<JsonObject> conditions, along;
        for (const hm_condition& condition : basis_.conditions()) {
            JsonObject& object = conditions.emplace_back();
            object.add("marker", condition.marker)
                .add("kind", std::string(kinds[condition.kind]))
                .add("partner", condition.partner);
            object.add("first_curve", condition.first_curve).add("n_curves", condition.n_curves);
            object.add("body", condition.body).add("x", condition.x).add("y", condition.y);
            object.add("is_piece", condition.piece != 0)
                .add("near_x", condition.near_x)
                .add("near_y", condition.near_y);
            object.add("along", place_of(condition.along));
        }
        for (const auto& set : basis_.slip_curves()) along.push_back(json_of(*set->view.get()));
        object_.add("conditions", conditions).add("along", along);
    }

    std::int32_t place_of(const hm_curves* along) const {
        const auto& sets = basis_.slip_curves();
        const auto found = std::find_if(sets.begin(), sets.end(), [along](const auto& set) {
            return set->view.get() == along;
        });
        return found == sets.end() ? -1 : static_cast<std::int32_t>(found - sets.begin());
    }

    const Mesh& mesh_;
    const Basis& basis_;
    JsonObject object_;
};

}  // namespace

bool can_be_solved_again(const Basis& basis, const Mesh& mesh) {
    const hm_basis_info& info = basis.info();
    if (info.modes > 0 || info.storage != HM_DOUBLE || info.engine != HM_DIRECT ||
        info.scheme != HM_COMPACT)
        return false;
    Task task = task_of(basis);
    task.known_points.clear();  // the page finds the parameters by projection
    task.known_curves.clear();
    task.known_u.clear();
    const Threads threads(1);
    Solver solver(mesh, task, threads);
    if (solver.run() != HM_OK) return false;
    const Basis again(solver.basis(), mesh);
    for (std::int32_t function = 0; function < info.functions; ++function) {
        for (std::int32_t number = 0; number < info.numbers_per_value; ++number) {
            const std::vector<double> one = basis.values(function, number, mesh),
                                      other = again.values(function, number, mesh);
            for (std::size_t k = 0; k < one.size(); ++k)
                if (!(std::fabs(one[k] - other[k]) <= max_difference)) return false;
        }
    }
    return true;
}

std::string explore_data(const Mesh& mesh, const Basis& basis, const std::string& moves) {
    ExploreWriter writer(mesh, basis);
    JsonObject& object = writer.run();
    std::string block;
    if (!can_be_solved_again(basis, mesh)) {
        const auto* bytes = reinterpret_cast<const char*>(basis.get());
        block = encode_base64({bytes, static_cast<std::size_t>(basis.info().bytes)});
    }
    return for_script(object.add("basis_file", block).add("moves", moves).text());
}

}  // namespace cli
