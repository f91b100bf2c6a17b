#include "cases.hpp"

#include <fixtures/hybrid.hpp>
#include <fixtures/mangle.hpp>
#include <fixtures/memory.hpp>

#include <cstdio>
#include <stdexcept>

namespace bench {
namespace {

using fixtures::Mesh;

double const pi = std::acos(-1.0);
double const radius = 20, outline_length = 2.04;  // [chord]

int half_of(double points) { return static_cast<int>(0.5 * points); }

// Cells as long as high: a ring at distance d is first + 2 pi d / columns high, so growth is
// geometric.
Mesh iso_mesh(double size) {
    double const rings_per_column = std::log1p(radius * 2 * pi / outline_length) / (2 * pi);
    int const n_side = half_of(std::sqrt(size / rings_per_column));
    int const rings = static_cast<int>(size / (2 * n_side)) - 1;
    return o_mesh(fixtures::naca4({}, n_side),
                  fixtures::stretched(outline_length / (2 * n_side), radius, rings));
}

// Two thirds as many rings as columns, as RANS meshes have.
Mesh viscous_mesh(double size, double first) {
    int const n_side = half_of(std::sqrt(1.5 * size));
    int const rings = static_cast<int>(size / (2 * n_side)) - 1;
    return o_mesh(fixtures::naca4({}, n_side), fixtures::stretched(first, radius, rings));
}

Mesh unstructured_mesh(double size) {
    double const points_per_square =
        0.22;  // of wall points; measured for this growth, the same at all sizes
    int const n_side = half_of(std::sqrt(size / points_per_square));
    fixtures::HybridOptions options;
    options.layers = 0;
    options.first = 0.87 * outline_length / (2 * n_side);
    options.ring_growth =
        1 + 2 * 2 * pi / (2 * n_side);  // twice what keeps the number of points in a ring
    options.radius = radius;
    return hybrid_mesh(fixtures::naca4({}, n_side), options);
}

// The unstructured mesh with all y divided by `by`, turned by 30 degrees.
Mesh stretched_mesh(double size, double by) {
    Mesh out = unstructured_mesh(size);
    double const c = std::cos(pi / 6), s = std::sin(pi / 6);
    for (std::size_t k = 0; k < out.x.size(); ++k) {
        double const x = out.x[k], y = out.y[k] / by;
        out.x[k] = c * x - s * y;
        out.y[k] = s * x + c * y;
    }
    return out;
}

}  // namespace

Case make_case(std::string const& kind, Index size) {
    Case out;
    out.kind = kind;
    if (kind == "iso") out.mesh = iso_mesh(size);
    else if (kind == "viscous") out.mesh = viscous_mesh(size, 1e-5);
    else if (kind == "thin") out.mesh = viscous_mesh(size, 1e-6);
    else if (kind == "thinnest") out.mesh = viscous_mesh(size, 1e-7);
    else if (kind == "unstructured") out.mesh = unstructured_mesh(size);
    else if (kind == "stretched10" || kind == "stretched100" || kind == "stretched1000")
        out.mesh = stretched_mesh(size, std::stod(kind.substr(9)));
    else throw std::invalid_argument("no such kind of mesh: " + kind);
    for (Index const marker : out.mesh.face_markers) out.wall_points += marker == fixtures::body;
    return out;
}

std::string Case::name() const {
    Index const n = mesh.n_points();
    char text[64];
    if (n >= 950000) std::snprintf(text, sizeof text, "%s %.1fM", kind.c_str(), n * 1e-6);
    else std::snprintf(text, sizeof text, "%s %.0fk", kind.c_str(), n * 1e-3);
    return text;
}

Fit::Fit(Case const& mesh_case, Index n_control) {
    // Faces run clockwise round the body, one from each of its points.
    fixtures::Mesh const& mesh = mesh_case.mesh;
    std::vector<double> x, y;
    for (Index face = mesh_case.wall_points; face-- > 0;) {
        std::size_t const from = at(mesh.faces[2 * at(face) + 1]);
        x.push_back(mesh.x[from]);
        y.push_back(mesh.y[from]);
    }
    // The list above begins at the trailing edge's neighbour or at the edge itself: the fit finds
    // the corner.
    hm_fit_options options{};
    options.struct_size = sizeof options;
    options.n_control = n_control;
    hm_error error{};
    std::size_t bytes = 0;
    require(fixtures::fit_size(mesh_case.wall_points, &options, &bytes, &error), error, "hm_fit");
    block_.reset(new unsigned char[bytes]);
    hm_points const wall{x.data(), y.data(), 1};
    hm_status const status = hm_fit(&curves_, fixtures::Memory(block_.get(), bytes), &wall,
                                    mesh_case.wall_points, 1, &options, nullptr, &error);
    require(status, error, "hm_fit");
}

Problem::Problem(Case const& mesh_case, Fit const& fit) : mesh(mesh_case.mesh.view()) {
    condition.struct_size = sizeof condition;
    condition.marker = fixtures::body;
    condition.kind = HM_ON_CURVE;
    condition.n_curves = fit.curves().n_curves;
    given.struct_size = sizeof given;
    given.mesh = &mesh;
    given.curves = &fit.curves();
    given.n_conditions = 1;
    given.conditions = &condition;
}

void require(hm_status status, hm_error const& error, const char* call) {
    if (status < 0)
        throw std::runtime_error(std::string(call) + ": " + hm_status_name(status) + ", " +
                                 error.text);
}

}  // namespace bench
