// PLOT3D grids (https://www.grc.nasa.gov/www/wind/valid/plot3d.html): one block or many, two
// dimensions or one cell thick (between planes of any direction, or in a wedge), in text, in
// binary, or in unformatted records of Fortran; plot3d_layout finds out which.
//
// Points on the sides of blocks with equal coordinates (within 1e-12 of the largest coordinate) are
// one point of the mesh. Thus interfaces between blocks and cuts are closed, and cells at a pole
// become triangles. The remaining sides are the boundary, with the names in a .nmf file beside the
// grid, or else BLOCK:SIDE, such as 1:jmin.
// Numbers with a repeat count, as 3*1.0, are expanded when the file is read, and remain expanded in
// the morphed file.
#include "basics/numbers.hpp"
#include "files/paths.hpp"
#include "formats/format.hpp"
#include "formats/plot3d_layout.hpp"
#include "formats/plot3d_reader.hpp"
#include "formats/repeats.hpp"

namespace cli {

namespace {

bool begins_with_number(const TextFile& file) {
    const std::string_view text = trimmed(file.text().substr(0, 256));
    return !text.empty() &&
           text.find_first_not_of("0123456789+-.eEdD*, \t\r\n") == std::string_view::npos;
}

bool has_usual_extension(const std::string& path) {
    const std::string extension = ending_of(path);
    for (const char* usual : {".p3d", ".p2d", ".xyz", ".x", ".grd", ".p3dfmt", ".p2dfmt", ".ufmt",
                              ".fmt", ".g", ".gu"}) {
        if (extension == usual) return true;
    }
    return false;
}

// A file that is cut off fits no layout, but its records or its name may still identify it.
bool probe_plot3d(const TextFile& file) {
    Plot3dLayout layout;
    std::string reason, expanded;
    if (find_plot3d_layout(file, layout, reason)) return true;
    if (begins_with_number(file) && expand_repeats(file, expanded)) {
        return find_plot3d_layout(TextFile(file.path(), expanded), layout, reason) ||
               has_usual_extension(file.path());
    }
    return (!reason.empty() && !begins_with_number(file)) || has_usual_extension(file.path());
}

void read_plot3d(Mesh& mesh, const ReadOptions&) {
    Plot3dLayout layout;
    std::string reason, expanded;
    if (expand_repeats(mesh.file, expanded)) {
        mesh.file = TextFile(mesh.file.path(), std::move(expanded));
        mesh.remark("repeat counts, as 3*1.0, are written out as single numbers");
    }
    if (!find_plot3d_layout(mesh.file, layout, reason)) {
        mesh.file.fail(mesh.file.text().size(),
                       "no layout of PLOT3D fits the file" + (reason.empty() ? "" : ": " + reason));
    }
    read_plot3d_blocks(mesh, layout);
}

}  // namespace

const Format plot3d_format = {
    "plot3d",     ".p3d",      "PLOT3D, 2D or one cell thick: text, binary, Fortran unformatted",
    probe_plot3d, read_plot3d, nullptr};

}  // namespace cli
