// CGNS files (https://cgns.github.io/CGNS_docs_current/sids), of both kinds that libcgns writes
// (HDF5 and ADF): the first base, all its zones, structured and unstructured, of two dimensions or
// one cell thick. Programs that are not made with `make CGNS=1` recognise such a file and
// refuse it.
//
// libcgns reads and writes; mesh.file keeps the coordinates alone, all x, then all y, then all z,
// in the machine's number format. A morphed file is a copy of the file in which libcgns overwrites
// the coordinate arrays. Markers are boundary conditions. Zones meet where their points have equal
// coordinates, as cuts do; connectivities are not read.
#include "formats/cgns.hpp"

#include "formats/cgns_read.hpp"
#include "formats/format.hpp"

namespace cli {

bool is_cgns(const TextFile& file) {
    const std::string_view text = file.text();
    return text.substr(0, 8) == std::string_view("\x89HDF\r\n\x1a\n", 8) ||
           text.substr(0, 64).find("ADF Database") != std::string_view::npos;
}

void refuse_cgns(const TextFile& file) {
    file.fail(
        0,
        "this is an HDF5 or ADF file: CGNS files are read by programs made with `make CGNS=1`, "
        "where libcgns is installed");
}

namespace {

#ifdef HARMORPH_CGNS
void read_cgns(Mesh& mesh, const ReadOptions&) { read_cgns(mesh); }
#else
void read_cgns(Mesh& mesh, const ReadOptions&) { refuse_cgns(mesh.file); }
#endif

}  // namespace

const Format cgns_format = {
    "cgns",  ".cgns",   "CGNS, 2D or one cell thick (programs made with CGNS=1)",
    is_cgns, read_cgns, nullptr};

}  // namespace cli
