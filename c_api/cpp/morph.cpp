// Morphs a structured O-mesh around an ellipse in C++17. Objects of harmorph live in blocks that
// this program owns, and a refused call becomes an exception.
#include <harmorph.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

// Memory of one object of the library. The memory is freed when the Block ends; nothing else has to
// be released. A Block can be moved, as the object itself then stays where it is.
class Block {
public:
    explicit Block(std::size_t bytes) : bytes_(bytes), memory_(new std::byte[bytes]) {}
    void* data() const { return memory_.get(); }
    std::size_t size() const { return bytes_; }

private:
    std::size_t bytes_;
    std::unique_ptr<std::byte[]> memory_;
};

// Passes warnings on, and throws the sentence of a refusal.
hm_status checked(hm_status status, const hm_error& error) {
    if (status >= 0) return status;
    throw std::runtime_error(std::string(hm_status_name(status)) + ": " + error.text);
}

// Makes a call twice: with an empty hm_memory, which receives the number of bytes, and with a
// block.
template <class Call>
Block reserved(const Call& call) {
    hm_memory memory{};
    call(&memory);
    Block block(memory.bytes);
    memory.block = block.data();
    call(&memory);
    return block;
}

// A structured O-mesh of ni x nj points; the first and the last column are the same points.
struct Ring {
    int ni, nj;
    std::vector<double> x, y;
    std::vector<std::int32_t> lists, start, markers;
};

Ring ring(int ni, int nj, std::int32_t wall, std::int32_t far) {
    Ring out{ni, nj, {}, {}, {}, {0, ni, 2 * ni}, {wall, far}};
    for (int j = 0; j < nj; ++j)
        for (int i = 0; i < ni; ++i) {
            const double angle = 6.283185307179586 * (i % (ni - 1)) / (ni - 1),
                         r = std::exp(3.0 * j / (nj - 1));
            out.x.push_back((r + .6 / r) * std::cos(angle));
            out.y.push_back((r - .6 / r) * std::sin(angle));
        }
    for (int i = 0; i < ni; ++i) out.lists.push_back(i);
    for (int i = 0; i < ni; ++i) out.lists.push_back(i + ni * (nj - 1));
    return out;
}

int main() try {
    constexpr std::int32_t wall = 1, far = 2;
    Ring grid = ring(129, 49, wall, far);
    hm_mesh mesh;
    HM_INIT(mesh);
    mesh.n_points = static_cast<std::int32_t>(grid.x.size());
    mesh.points = {grid.x.data(), grid.y.data(), 1};
    mesh.cell_layout = HM_CELLS_STRUCTURED;
    mesh.ni = grid.ni;
    mesh.nj = grid.nj;
    mesh.n_lists = 2;
    mesh.list_start = grid.start.data();
    mesh.list_points = grid.lists.data();
    mesh.list_markers = grid.markers.data();
    hm_error error;

    // A periodic cubic B-spline with 12 control points through the points of the wall.
    hm_fit_options fit;
    HM_INIT(fit);
    fit.n_control = 12;
    fit.closed = HM_PERIODIC;
    const hm_curves* curves;
    const Block curve_block = reserved([&](hm_memory* memory) {
        checked(hm_fit_marker(&curves, memory, &mesh, 1, &wall, &fit, nullptr, &error), error);
    });

    // One function for each control point.
    hm_condition on_curve;
    HM_INIT(on_curve);
    on_curve.marker = wall;
    on_curve.kind = HM_ON_CURVE;
    on_curve.n_curves = 1;
    hm_problem problem;
    HM_INIT(problem);
    problem.mesh = &mesh;
    problem.curves = curves;
    problem.n_conditions = 1;
    problem.conditions = &on_curve;
    hm_setup setup;
    HM_INIT(setup);
    const Block first = reserved([&](hm_memory* memory) {
        checked(hm_setup_init(&setup, memory, &problem, nullptr, &error), error);
    });
    const Block second = reserved([&](hm_memory* memory) {
        checked(hm_setup_solve(&setup, memory, nullptr, &error), error);
    });
    const hm_basis* const basis = setup.basis;

    // The upper control points go up. The displacements are judged before the mesh moves.
    std::vector<double> move(2 * 12), dx(grid.x.size()), dy(grid.x.size());
    for (std::size_t i = 0; i < 12; ++i)
        if (curves->control[2 * i + 1] > 0.05) move[2 * i + 1] = .1;
    const hm_points displacement{dx.data(), dy.data(), 1};
    const hm_points_out to_displacement{dx.data(), dy.data(), 1};
    const hm_points_out to_mesh{grid.x.data(), grid.y.data(), 1};
    hm_step_report step;
    hm_quality_report quality;
    HM_INIT(step);
    HM_INIT(quality);
    checked(hm_morph(basis, move.data(), nullptr, &to_displacement, nullptr, &error), error);
    checked(
        hm_assess(basis, &mesh, nullptr, &displacement, nullptr, nullptr, &step, &quality, &error),
        error);
    std::printf("%d inverted cells; the mesh could follow %.1f times as far\n", quality.inverted,
                step.admissible);
    if (quality.inverted > 0) return 1;
    checked(hm_morph(basis, move.data(), &mesh.points, &to_mesh, nullptr, &error), error);
    return 0;
} catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
}
