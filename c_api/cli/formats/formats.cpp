// The table of formats, and the steps that reading has in common for all formats.
#include "basics/failure.hpp"
#include "basics/text.hpp"
#include "files/output_file.hpp"
#include "files/paths.hpp"
#include "formats/deflate.hpp"
#include "formats/format.hpp"
#include "formats/vtk_parallel.hpp"
#include "mesh/tidy.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <system_error>

namespace cli {

namespace {

// Formats are probed in this order: those with a signature first.
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
    throw Failure(exit_usage, "the format " + in_quotes(name) +
                                  " is unknown; the known formats are " + format_names());
}

const Format& format_of(const TextFile& file) {
    for (const Format* format : formats) {
        if (format->probe(file)) return *format;
    }
    const std::string_view first = file.text().substr(0, file.text().find_first_of("\r\n"));
    file.fail(0, (file.text().empty() ? "the file is empty"
                                      : "no known mesh file begins with " + in_quotes(first)) +
                     "; the formats that are read are " + format_names() +
                     " (--format chooses one)");
}

// Returns the function that compresses what `store` writes. If no number changed, the function
// writes the bytes of the compressed file as they were read.
FileCoordinates::Store packed(const TextFile& compressed, const FileCoordinates::Store& store) {
    return [compressed, store](std::ostream& out, const Mesh& mesh, const std::string& numbers) {
        if (numbers == mesh.file.text()) {
            out << compressed.text();
        } else if (!store) {
            out << gzip(numbers);
        } else {
            std::ostringstream text;
            store(text, mesh, numbers);
            out << gzip(text.str());
        }
    };
}

}  // namespace

std::string format_table() {
    std::string table;
    for (const Format* format : formats) {
        const char* const written = format->create ? " (also written by convert)" : "";
        table += help_line(format->name, format->title + std::string(written), 12);
    }
    return table;
}

bool is_mesh_file(const TextFile& file) {
    const auto* const found = std::find_if(std::begin(formats), std::end(formats),
                                           [&](const Format* one) { return one->probe(file); });
    return found != std::end(formats);
}

std::string mesh_file(const std::string& path) {
    if (!is_folder(path)) return path;  // an error is reported when the file is opened
    for (const char* place : {"constant/polyMesh/points", "polyMesh/points", "points"}) {
        for (const char* ending : {"", ".gz"}) {
            const std::string points = path_in(path, place) + ending;
            if (exists(points)) return points;
        }
    }
    return path;
}

std::vector<std::string> files_beside_mesh(const std::string& path) {
    const std::string mesh = mesh_file(path), folder = folder_of(mesh), last = last_name(mesh);
    std::vector<std::string> candidates;
    for (const Format* format : formats) {
        if (format->names_file != nullptr) candidates.push_back(format->names_file(mesh));
    }
    if (last == "points" || last == "points.gz") {
        for (const char* name : {"faces", "owner", "neighbour", "boundary"}) {
            candidates.push_back(path_in(folder, name));
            candidates.push_back(path_in(folder, name) + ".gz");
        }
    }
    if (ending_of(mesh) == ".pvtu") {
        for (const std::string& piece : piece_files(mesh)) candidates.push_back(piece);
    }
    std::vector<std::string> files;
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(files), exists);
    return files;
}

std::string names_file(const Mesh& mesh, const std::string& path) {
    const bool has_none = mesh.format == nullptr || mesh.format->names_file == nullptr;
    return has_none ? "" : mesh.format->names_file(path);
}

namespace {

// Tells whether the folder is a time of a case of OpenFOAM: its name is a number, and it is beside
// the folder constant. OpenFOAM reads the points of a mesh that has moved from polyMesh in this
// folder, and everything else from constant/polyMesh.
bool is_time_of_case(const std::string& path) {
    const std::string name = last_name(path);
    return !name.empty() && name.find_first_not_of("0123456789.") == std::string::npos &&
           name.find_first_of("0123456789") != std::string::npos &&
           is_folder(path_in(folder_of(path), "constant/polyMesh"));
}

// Returns the file of the points at a time, and makes its folders if they do not exist.
std::string points_at_time(const Mesh& mesh, const std::string& time) {
    const std::string folder = path_in(time, "polyMesh");
    make_folders(folder);
    return path_in(folder, mesh.in_file.is_packed ? "points.gz" : "points");
}

}  // namespace

std::string moved_file(const Mesh& mesh, const std::string& path) {
    const bool ends_in_slash = last_name(path).empty();
    const std::string folder = ends_in_slash ? folder_of(path) : path;
    const std::string points = last_name(mesh.file.path());
    const bool is_time = (points == "points" || points == "points.gz") && is_time_of_case(folder);
    const std::string file = is_time ? points_at_time(mesh, folder) : mesh_file(path);
    if (mesh.in_file.is_joined && !is_device(file) && !ends_with(file, ".vtu")) {
        throw Failure(exit_usage,
                      mesh.file.path() +
                          " names the files of several pieces, and a morphed mesh is one file of "
                          "all pieces: the name of the file to write, " +
                          in_quotes(file) + ", must end in .vtu");
    }
    if (is_device(file) || mesh.in_file.is_packed == ends_with(file, ".gz")) return file;
    const bool is_packed = mesh.in_file.is_packed;
    throw Failure(
        exit_usage,
        mesh.file.path() + " is " + (is_packed ? "" : "not ") +
            "compressed by gzip, and a morphed mesh is the same file with other coordinates: the "
            "name of the file to write, " +
            in_quotes(file) + ", must " + (is_packed ? "end in .gz, too" : "not end in .gz"));
}

void refuse_zone_of_one(const std::string& chosen) {
    if (chosen.empty() || chosen == "1") return;
    throw Failure(exit_usage, "--zone " + chosen + ": the file has one zone only");
}

Mesh read_mesh_file(const std::string& path, const ReadOptions& options) {
    const Format* forced = options.format.empty() ? nullptr : find_format(options.format);
    const std::string file = mesh_file(path);
    if (is_folder(file))
        throw Failure(exit_file,
                      path +
                          ": the folder has no mesh of OpenFOAM: neither "
                          "constant/polyMesh/points nor polyMesh/points nor points is in "
                          "it, with or without .gz");
    Mesh mesh(file);
    const TextFile as_read = mesh.file;
    const bool is_packed = is_gzip(as_read.text());
    if (is_packed) mesh.file = unpacked(as_read);
    const Format& format = forced ? *forced : format_of(mesh.file);
    mesh.file.listen(options.progress);
    mesh.threads = options.threads;
    mesh.format = &format;
    if (&format != &su2_format) refuse_zone_of_one(options.zone);
    format.read(mesh, options);
    mesh.file.listen(nullptr);
    mesh.in_file.is_packed = is_packed && !mesh.in_file.is_joined;
    if (mesh.in_file.is_packed) mesh.in_file.store = packed(as_read, mesh.in_file.store);
    if (mesh.points() == 0 || mesh.cells() == 0)
        mesh.file.fail(0, mesh.points() == 0 ? "the file has no points" : "the file has no cells");
    check_points(mesh);
    drop_interior_faces(mesh, true);
    return mesh;
}

namespace {

// Returns the format that the ending of the path asks for, if this is not that of the mesh, or
// NULL. Refuses the ending of a format in which no new file can be written.
const Format* other_format(const Mesh& mesh, const std::string& path) {
    const std::string ending = ending_of(path);
    if (mesh.format == nullptr || is_device(path) || ending.empty() ||
        ending == ending_of(mesh.file.path()))
        return nullptr;
    const Format* other = nullptr;
    bool is_known = false;
    for (const Format* format : formats) {
        if (ending != format->extension) continue;
        if (format == mesh.format) return nullptr;
        is_known = true;
        if (other == nullptr && format->create != nullptr) other = format;
    }
    return is_known && other == nullptr ? &format_to_create("", path) : other;
}

// Writes the names of markers that lie beside the mesh beside its moved file, as one of `files`.
std::vector<std::string> copy_names(OutputFiles& files, const Mesh& mesh, const std::string& path) {
    const std::string from = names_file(mesh, mesh.file.path()), to = names_file(mesh, path);
    if (from.empty() || is_device(path) || is_same_file(from, to)) return {};
    if (exists(from) && !exists(to)) files.add(to) << TextFile(from).text();
    if (!exists(to) || (exists(from) && TextFile(from).text() == TextFile(to).text())) return {};
    return {"the markers will have the names in " + to + ", which was there before" +
            (exists(from) ? " and differs from " + from : "; " + from + " does not exist")};
}

}  // namespace

std::vector<std::string> write_moved(OutputFiles& files, const Mesh& mesh, const std::string& path,
                                     const double* x, const double* y) {
    const Format* const other = other_format(mesh, path);
    if (other == nullptr) {
        const std::string file = moved_file(mesh, path);
        write_moved(files.add(file), mesh, x, y);
        return copy_names(files, mesh, file);
    }
    Mesh moved = mesh;
    moved.x.assign(x, x + mesh.x.size());
    moved.y.assign(y, y + mesh.y.size());
    std::vector<std::string> sentences = make_writable(moved, *other);
    other->create(files.add(path), moved);
    return sentences;
}

std::vector<std::string> make_writable(Mesh& mesh, const Format& format) {
    std::vector<std::string> sentences;
    if (!format.has_markers) return sentences;
    const std::string_view refused = format.not_in_names;
    std::set<std::string> names(mesh.markers.begin(), mesh.markers.end());
    for (std::string& name : mesh.markers) {
        std::string other = name;
        for (std::size_t k = 0; k < other.size(); ++k) {
            const bool is_control = static_cast<unsigned char>(other[k]) < 32;
            const bool is_outer_blank = other[k] == ' ' && (k == 0 || k + 1 == other.size());
            if (refused.find(other[k]) != refused.npos || is_control || is_outer_blank)
                other[k] = '_';
        }
        if (other.empty()) other = "_";
        if (other == name) continue;
        while (names.count(other) > 0) other += '_';
        names.insert(other);
        const std::string why = name.empty() ? " must not be empty" : " have no such characters";
        sentences.push_back("the marker " + in_quotes(name) + " is written as " + in_quotes(other) +
                            ": names in the format " + format.name + why);
        name = other;
    }
    return sentences;
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
