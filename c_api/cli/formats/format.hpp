// Formats of mesh files. A source in this folder defines the `Format` of each, and the table in
// formats.cpp lists it.
#pragma once

#include "mesh/mesh_file.hpp"

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

class OutputFiles;

struct ReadOptions {
    std::int32_t threads = 1;
    std::string format;                    // the name of the format; empty: found from the content
    std::string zone;                      // the zone to read; empty: the file must have only one
    std::function<void(double)> progress;  // gets the part that has been read, 0 .. 1; may be empty
};

struct Format {
    const char* name;       // for --format
    const char* extension;  // of new files, with the dot
    const char* title;
    bool (*probe)(const TextFile& file);  // tells whether the content looks like this format
    // Reads mesh.file and fills all other members of the mesh, or throws a Failure.
    void (*read)(Mesh& mesh, const ReadOptions& options);
    // Writes a new file with points, cells and markers. NULL: convert cannot write the format.
    void (*create)(std::ostream& out, const Mesh& mesh);
    bool has_markers = true;
    const char* not_in_names = "";  // characters that names of markers in new files cannot have
    // Returns the file with the names of markers beside a mesh with this path; the file need not
    // exist. NULL: the names are in the mesh.
    std::string (*names_file)(const std::string& mesh) = nullptr;
};

extern const Format cgns_format, fluent_format, gmsh_format, openfoam_format, plot3d_format,
    su2_format, ugrid_format, vtk_format, vtk_xml_format;

bool is_mesh_file(const TextFile& file);  // tells whether the content is that of one of the formats

// Returns the file of the points, which is read and written, if the path is a case of OpenFOAM or a
// folder polyMesh; otherwise the path.
std::string mesh_file(const std::string& path);

// The files beside the mesh with this path that belong to the mesh, as far as they exist: names of
// markers (.nmf, .mapbc), and all other files of OpenFOAM's polyMesh.
std::vector<std::string> files_beside_mesh(const std::string& path);

// The file with names of markers beside a file of this mesh with this path; the file need not
// exist. Empty: the names are in the mesh.
std::string names_file(const Mesh& mesh, const std::string& path);

// Returns the file that a morphed mesh with this path is written to, as mesh_file() does. If the
// path is a time of a case of OpenFOAM, CASE/1, this is CASE/1/polyMesh/points; the folders are
// made. Refuses a path as wrong usage that ends in .gz although the mesh was not compressed, that
// does not although it was, or that does not end in .vtu although the mesh was a file .pvtu.
std::string moved_file(const Mesh& mesh, const std::string& path);

// Reads a mesh, which may be compressed by gzip. Refuses, with the line or byte of the file, other
// files and meshes that cannot be morphed.
Mesh read_mesh_file(const std::string& path, const ReadOptions& options);
// For files that have no zones: refuses another zone than the first.
void refuse_zone_of_one(const std::string& chosen);

// Writes the file of the mesh with the coordinates that changed. They have as many digits as the
// file has, or more where these would move a point by more than a thousandth of its shortest edge.
void write_moved(std::ostream& out, const Mesh& mesh, const double* x, const double* y);

// Writes the mesh with these coordinates to a path, as one of `files`. The ending of the path
// decides the format: the file of the mesh with other coordinates, as above, if the ending is that
// of the mesh, of its format, or of no format; otherwise a new file, as `convert` writes it. The
// ending of a format in which no new file can be written is refused. A file with names of markers
// beside the mesh of the same format is copied to its place beside the path, unless a file is
// there. Returns the sentences of make_writable(), and one about a file there that has other names.
std::vector<std::string> write_moved(OutputFiles& files, const Mesh& mesh, const std::string& path,
                                     const double* x, const double* y);

// Rounds the coordinates to single precision if the file has them in single precision.
void round_as_file(const Mesh& mesh, std::vector<double>& x, std::vector<double>& y);

// Returns the format of this name, or, if the name is empty, the format of the extension of the
// path.
const Format& format_to_create(const std::string& name, const std::string& path);

// Replaces characters in the names of markers that a new file of this format cannot hold, and an
// empty name, by _, so that names stay different. Returns a sentence for each marker that was
// renamed.
std::vector<std::string> make_writable(Mesh& mesh, const Format& format);

std::string format_table();  // for the help of commands: a line for each format

}  // namespace cli
