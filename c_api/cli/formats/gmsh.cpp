// Gmsh's MSH files (https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format), versions 2 and 4.1,
// in text and binary, of two dimensions or one cell thick.
//
// Markers are the physical groups of curves, or of surfaces in meshes one cell thick, by name if
// there is one; a curve or surface without a group is "curve:TAG" or "surface:TAG".
#include "basics/text_out.hpp"
#include "files/ordered_output.hpp"
#include "formats/format.hpp"
#include "formats/gmsh_read.hpp"

#include <ostream>

namespace cli {

namespace {

// The section $MeshFormat is the first one, or $Comments.
bool probe_gmsh(const TextFile& file) {
    const std::string_view text = trimmed(file.text().substr(0, 64));
    return text.size() > 1 && text[0] == '$' && text[1] >= 'A' && text[1] <= 'Z';
}

void read_gmsh(Mesh& mesh, const ReadOptions&) { build_mesh(mesh, read_gmsh(mesh)); }

// Writes version 2.2, which all programs read. The cells are the physical surface 1, and the
// markers are the physical curves from 2 on.
void create_gmsh(std::ostream& out, const Mesh& mesh) {
    mesh.refuse_polygons("Gmsh");
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
        << mesh.markers.size() + 1 << "\n2 1 \"domain\"\n";
    for (std::size_t marker = 0; marker < mesh.markers.size(); ++marker) {
        out << "1 " << marker + 2 << " \"" << mesh.markers[marker] << "\"\n";
    }
    out << "$EndPhysicalNames\n$Nodes\n" << mesh.points() << '\n';
    write_rows(out, mesh.x.size(), mesh.threads, [&](std::size_t i, TextOut& to) {
        (to << i + 1 << ' ').exact(mesh.x[i]);
        (to << ' ').exact(mesh.y[i]) << " 0\n";
    });
    out << "$EndNodes\n$Elements\n" << mesh.faces() + mesh.cells() << '\n';
    const std::size_t n_faces = mesh.face_markers.size();
    for (std::size_t face = 0; face < n_faces; ++face) {
        const std::int32_t tag = mesh.face_markers[face] + 2;
        out << face + 1 << " 1 2 " << tag << ' ' << tag << ' ' << mesh.face_points[2 * face] + 1
            << ' ' << mesh.face_points[2 * face + 1] + 1 << '\n';
    }
    write_rows(out, mesh.cell_start.size() - 1, mesh.threads, [&](std::size_t cell, TextOut& to) {
        const std::int32_t begin = mesh.cell_start[cell], end = mesh.cell_start[cell + 1];
        to << n_faces + cell + 1 << (end - begin == 3 ? " 2 2 1 1" : " 3 2 1 1");
        for (std::int32_t i = begin; i < end; ++i)
            to << ' ' << mesh.cell_points[static_cast<std::size_t>(i)] + 1;
        to << '\n';
    });
    out << "$EndElements\n";
}

}  // namespace

const Format gmsh_format = {
    "gmsh",     ".msh",    "Gmsh MSH 2.0 to 2.2 and 4.1, 2D or one cell thick",
    probe_gmsh, read_gmsh, create_gmsh,
    true,       "\""};

}  // namespace cli
