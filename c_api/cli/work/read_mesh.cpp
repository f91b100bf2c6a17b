#include "work/read_mesh.hpp"

#include "basics/print.hpp"
#include "basics/progress.hpp"
#include "mesh/mesh_file.hpp"

namespace cli {

Mesh read_mesh(const std::string& path, const ReadOptions& options) {
    ProgressBar bar;
    ReadOptions watched = options;
    watched.progress = [&bar](double fraction) { bar.draw("reading", fraction); };
    Mesh mesh = read_mesh_file(path, watched);
    bar.wipe();
    number_by_name(mesh);
    for (const std::string& remark : mesh.remarks) warn(path + ": " + remark);
    return mesh;
}

Mesh read_mesh(const Arguments& arguments, std::size_t operand) {
    ReadOptions options;
    options.threads = threads_of(arguments);
    if (arguments.has("--format")) options.format = arguments.text("--format");
    if (arguments.has("--zone")) options.zone = arguments.text("--zone");
    return read_mesh(arguments.operand(operand), options);
}

}  // namespace cli
