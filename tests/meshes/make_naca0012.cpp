// Writes naca0012.su2: a hybrid mesh round a NACA0012 with a sharp trailing edge, chord 1, far
// field 20 chords away. `make meshes` runs this program.
#include <fixtures/hybrid.hpp>
#include <fixtures/su2.hpp>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_naca0012 FILE\n");
        return 2;
    }
    fixtures::HybridOptions
        options;  // the triangles just outside the layers come out as high as the last quads are
    options.layers = 15;
    options.layer_growth = 1.22;
    options.ring_growth = 1.15;
    fixtures::Mesh const mesh = fixtures::hybrid_mesh(fixtures::naca4({}, 66), options);
    std::map<std::int32_t, std::string> const names{{fixtures::body, "airfoil"},
                                                    {fixtures::far_field, "farfield"}};
    bool const written = fixtures::write_su2(mesh, argv[1], names);
    if (!written) std::perror(argv[1]);
    return written && fixtures::check(mesh).sound() ? 0 : 1;
}
