// The table of formats, and what all of them have in common.
#include "formats/format.hpp"

#include "basics/failure.hpp"
#include "formats/tidy.hpp"

#include <filesystem>
#include <system_error>

namespace cli {

namespace {

// Probed in this order: formats with a signature first.
const Format* const formats[] = {&gmsh_format,  &fluent_format,  &openfoam_format,
                                 &vtk_format,   &vtk_xml_format, &su2_format,
                                 &ugrid_format, &cgns_format,    &plot3d_format};

std::string format_names() {
    std::string names;
    for (const Format* format : formats)
        names += (names.empty() ? "" : ", ") + std::string(format->name);
    return names;
}

const Format* find_format(const std::string& name) {
    for (const Format* format : formats) {
        if (name == format->name) return format;
    }
    throw Failure(exit_usage,
                  "unknown format " + in_quotes(name) + ": known are " + format_names());
}

const Format& format_of(const TextFile& file) {
    for (const Format* format : formats) {
        if (format->probe(file)) return *format;
    }
    const std::string_view first =
        std::string_view(file.text()).substr(0, file.text().find_first_of("\r\n"));
    file.fail(0,
              (file.text().empty() ? "the file is empty"
                                   : "no mesh file that is known begins with " + in_quotes(first)) +
                  "; read are " + format_names() + " (--format chooses)");
}

}  // namespace

std::string format_table() {
    std::string table;
    for (const Format* format : formats) {
        std::string name = "  " + std::string(format->name);
        name.resize(12, ' ');
        table += name + format->title + (format->create ? " (also written by convert)" : "") + '\n';
    }
    return table;
}

std::string mesh_file(const std::string& path) {
    std::error_code ignored;  // whoever opens the file says what is wrong with its name
    if (!std::filesystem::is_directory(path, ignored)) return path;
    for (const char* place : {"constant/polyMesh/points", "polyMesh/points", "points"}) {
        const std::filesystem::path points = std::filesystem::path(path) / place;
        if (std::filesystem::exists(points, ignored)) return points.string();
    }
    return path;
}

Mesh read_mesh_file(const std::string& path, const ReadOptions& options) {
    const Format* forced = options.format.empty() ? nullptr : find_format(options.format);
    Mesh mesh(mesh_file(path));
    const Format& format = forced ? *forced : format_of(mesh.file);
    mesh.file.listen(options.progress);
    format.read(mesh, options);
    mesh.file.listen(nullptr);
    check_points(mesh);
    drop_interior_faces(mesh, true);
    return mesh;
}

const Format& format_to_create(const std::string& name, const std::string& path) {
    std::string known;
    for (const Format* format : formats) {
        if (!format->create) continue;
        if (name.empty() ? ends_with(path, format->extension) : name == format->name)
            return *format;
        known += (known.empty() ? "" : ", ") + std::string(format->name) + " (" +
                 format->extension + ")";
    }
    const std::string why = name.empty() ? path + ": no format has this extension"
                                         : "format " + in_quotes(name) + " is not written";
    throw Failure(exit_usage, why + "; new files are " + known);
}

}  // namespace cli
