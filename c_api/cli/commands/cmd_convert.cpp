// harmorph convert: writes a mesh as a new file of another format.
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"
#include "work/read_mesh.hpp"

namespace cli {

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

}  // namespace cli
