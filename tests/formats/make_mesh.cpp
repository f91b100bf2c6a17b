// Writes one and the same ring of quads in many kinds of files, independently of the program. After
// the program has read a file and written the ring with other coordinates, the result must be, byte
// for byte, the file that is written here with those coordinates.
//
//   make_mesh KIND FILE [COORDINATES]   COORDINATES: an SU2 file of the ring, from which x and y
//   are taken make_mesh list                      all kinds
#include "ring/fluent_solid.hpp"
#include "ring/gmsh.hpp"
#include "ring/plot3d.hpp"
#include "ring/su2.hpp"
#include "ring/ugrid.hpp"
#include "ring/vtk.hpp"
#include "ring/vtu.hpp"

#include <iostream>

int main(int argc, char** argv) {
    ring::Kinds kinds;
    for (const ring::Kinds& family :
         {ring::su2_kinds(), ring::gmsh_kinds(), ring::plot3d_kinds(), ring::ugrid_kinds(),
          ring::vtk_kinds(), ring::vtu_kinds(), ring::fluent_kinds(), ring::fluent_solid_kinds()}) {
        kinds.insert(family.begin(), family.end());
    }
    if (argc == 2 && std::string(argv[1]) == "list") {
        for (const auto& kind : kinds) std::cout << kind.first << "\n";
        return 0;
    }
    kinds["fluent-polygons.msh"] = [] {  // convert cannot write its cells
        return ring::fluent_solid(ring::FluentNumbers::text, true);
    };
    if (argc < 3 || kinds.count(argv[1]) == 0) return 2;
    if (argc > 3) ring::read_coordinates(argv[3]);
    else ring::make_coordinates();
    std::ofstream(argv[2], std::ios::binary) << kinds.at(argv[1])();
    return 0;
}
