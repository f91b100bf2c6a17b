// Formats of mesh files. Each has a file here that defines one `Format`, and a row in the table of
// formats.cpp.
#pragma once

#include "mesh/mesh_file.hpp"

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct ReadOptions {
    std::string format;  // empty: found by content
    std::string zone;    // of a file that has several; empty: the file must have one
    std::function<void(double)>
        progress;  // hears which part of the file has been read, 0 .. 1; may be empty
};

struct Format {
    const char* name;       // for --format
    const char* extension;  // of new files, with the dot
    const char* title;
    bool (*probe)(const TextFile& file);  // does the content look like it?
    void (*read)(
        Mesh& mesh,
        const ReadOptions& options);  // mesh.file is there; fills the rest, or throws a Failure
    void (*create)(std::ostream& out,
                   const Mesh& mesh);  // a new file with points, cells, markers; NULL: not written
    bool has_markers = true;
    const char* not_in_names = "";  // characters that a name of a marker cannot have in new files
};

extern const Format cgns_format, fluent_format, gmsh_format, openfoam_format, plot3d_format,
    su2_format, ugrid_format, vtk_format, vtk_xml_format;

bool is_mesh_file(const TextFile& file);  // is the content that of one of the formats?

// Of a folder of OpenFOAM (a case, or polyMesh) the file of its points, which is what is read and
// written; else the path.
std::string mesh_file(const std::string& path);

// The files beside the mesh with this path that belong to the mesh, as far as they exist: names of
// markers (.nmf, .mapbc), and all other files of OpenFOAM's polyMesh.
std::vector<std::string> files_beside_mesh(const std::string& path);

// The file that a morphed mesh with this path goes to, as mesh_file says. The name ends in .gz if
// the mesh was compressed, and only then; otherwise this is wrong usage.
std::string moved_file(const Mesh& mesh, const std::string& path);

// Files compressed by gzip are read, and written again, as such. Refuses, with the file's line or
// byte, what is none of the formats or not a mesh that can be morphed.
Mesh read_mesh_file(const std::string& path, const ReadOptions& options);

// The mesh's file as it is, except for coordinates that changed. They are written with the file's
// own number of digits, or with more where those would move a point by more than a thousandth of
// its shortest edge.
void write_moved(std::ostream& out, const Mesh& mesh, const double* x, const double* y);

// The coordinates that the file can hold: rounded, if they are numbers of the file, binary and in
// single precision.
void round_as_file(const Mesh& mesh, std::vector<double>& x, std::vector<double>& y);

// A new file in the format of that name, or if it is empty of the path's extension.
const Format& format_to_create(const std::string& name, const std::string& path);

// Replaces in the names of markers what a new file of this format cannot hold by _, so that names
// stay different. Returns a sentence for each marker that has another name then.
std::vector<std::string> make_writable(Mesh& mesh, const Format& format);

std::string format_table();  // for people: a line for each, with its name and what it is

}  // namespace cli
