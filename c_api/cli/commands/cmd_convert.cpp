// harmorph convert: writes a mesh as a new file of another format.
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"
#include "work/read_mesh.hpp"

namespace cli {

namespace {

void run_convert(const Arguments& arguments) {
    const std::string& path = arguments.operand(1);
    const std::string name = arguments.has("--to") ? arguments.text("--to") : "";
    const Format& format = format_to_create(name, path);
    Mesh mesh = read_mesh(arguments, 0);
    warn_of(path, make_writable(mesh, format));
    OutputFiles files;
    format.create(files.add(path), mesh);
    files.commit();
    const std::string markers = plural(static_cast<std::int64_t>(mesh.markers.size()), "marker");
    print("written        %s: %s, %s, %s%s (%s)\n", path.c_str(),
          plural(mesh.points(), "point").c_str(), plural(mesh.cells(), "cell").c_str(),
          format.has_markers ? "" : "without the ", markers.c_str(), format.title);
}

}  // namespace

const Command convert_command = {
    "convert",
    {{"MESH", FileUse::mesh}, {"NEW", FileUse::output}},
    "Writes a mesh as a new file of another format",
    "The new file has the points, cells and markers of MESH; files of VTK have no markers. Of a "
    "mesh one cell thick it has\n"
    "those of the plane. Other contents of MESH are not written. Numbers have all digits.\n",
    {format_option,
     zone_option,
     {"--to", "NAME", "format of NEW (default: that of the extension of NEW)"},
     threads_option},
    "  harmorph convert naca0012.su2 naca0012.msh\n",
    run_convert};

}  // namespace cli
