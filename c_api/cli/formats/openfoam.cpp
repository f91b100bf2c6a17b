// OpenFOAM's polyMesh
// (https://www.openfoam.com/documentation/user-guide/4-mesh-generation-and-conversion): the mesh is
// the file `points`, in text or binary; the files faces, owner and boundary lie in the same folder,
// or in constant/polyMesh. The two planes are the patches of type empty, or two patches of type
// wedge. All other patches are markers.
#include "basics/numbers.hpp"
#include "files/paths.hpp"
#include "formats/deflate.hpp"
#include "formats/foam_list.hpp"
#include "formats/format.hpp"
#include "mesh/space_mesh.hpp"

#include <harmorph_space.h>

#include <algorithm>
#include <numeric>

namespace cli {

namespace {

struct Patch {
    std::string name, type, neighbour;
    std::int64_t n_faces = -1, start_face = -1;
    std::size_t offset = 0;
};

std::vector<Patch> read_boundary(const TextFile& file) {
    FoamReader reader(file);
    const std::int64_t n = reader.count("the number of patches");
    std::vector<Patch> patches;
    reader.expect("(");
    for (std::int64_t i = 0; i < n; ++i) {
        Patch patch;
        patch.name = std::string(reader.word());
        patch.offset = reader.offset();
        if (patch.name.empty() || patch.name == ")") reader.expected("the name of a patch");
        reader.expect("{");
        while (!reader.is_next("}")) {
            const std::string key(reader.word());
            if (key.empty()) reader.expected("an entry of the patch, or '}'");
            if (key == "type") patch.type = std::string(reader.word());
            else if (key == "neighbourPatch") patch.neighbour = std::string(reader.word());
            else if (key == "nFaces") patch.n_faces = reader.count("the number of faces");
            else if (key == "startFace") patch.start_face = reader.count("the first face");
            for (std::string_view word = reader.word(); word != ";"; word = reader.word()) {
                if (word.empty()) reader.expected("';'");
            }
        }
        reader.expect("}");
        if (patch.n_faces < 0 || patch.start_face < 0 || patch.type.empty()) {
            file.fail(patch.offset,
                      "the patch " + in_quotes(patch.name) + " has no type, nFaces or startFace");
        }
        patches.push_back(patch);
    }
    reader.expect(")");
    return patches;
}

class PolyMesh {
public:
    explicit PolyMesh(Mesh& mesh) : mesh_(mesh), folder_(folder_of(mesh.file.path())) {}

    void read() {
        FoamReader points(mesh_.file);
        points.vectors(space_.points.x, space_.points.offset);
        if (points.header().is_binary) {
            mesh_.in_file.kind =
                points.header().scalar_bytes == 8 ? NumberKind::real64 : NumberKind::real32;
        }
        const TextFile faces = beside("faces"), owners = beside("owner"),
                       boundary = beside("boundary");
        std::vector<std::size_t> offsets;
        FoamReader(faces).faces(start_, points_, offsets);
        owner_ = FoamReader(owners).labels(n_faces());
        check(faces, offsets, owners);
        patches_ = read_boundary(boundary);
        n_cells_ = owner_.empty() ? 0 : 1 + *std::max_element(owner_.begin(), owner_.end());
        std::int64_t in_patches = 0;
        for (const Patch& patch : patches_) {
            if (patch.type.compare(0, 9, "processor") == 0) {
                boundary.fail(patch.offset,
                              "the patch " + in_quotes(patch.name) + " has the type " + patch.type +
                                  ": this is one part of a decomposed case; take the whole mesh, "
                                  "which reconstructParMesh puts together");
            }
            if (patch.start_face + patch.n_faces > n_faces()) {
                const std::string name = in_quotes(patch.name),
                                  last = std::to_string(n_faces() - 1);
                boundary.fail(patch.offset, "the patch " + name + " ends after face " + last +
                                                ", which is the last face of the mesh");
            }
            in_patches += patch.n_faces;
            if (in_patches > n_faces()) {
                const std::string name = in_quotes(patch.name);
                boundary.fail(patch.offset, "the patches up to " + name +
                                                " have more faces than the mesh, which has " +
                                                std::to_string(n_faces()));
            }
        }
        const std::vector<std::int64_t> plane = plane_faces(boundary);
        for (const std::int64_t face : plane) add_plane_face(face);
        add_sides();
        add_interfaces();
        take_plane(mesh_, space_);
        mesh_.find_polygons();
    }

private:
    TextFile beside(const char* name) const {
        // The folder of a time may have only the points of a mesh that has moved.
        for (const std::string& folder : {folder_, path_in(folder_, "../../constant/polyMesh")}) {
            const std::string path = path_in(folder, name), compressed = path + ".gz";
            if (exists(path)) return TextFile(path);
            if (exists(compressed)) return read_unpacked(compressed);
        }
        throw_missing(path_in(folder_, name) + " does not exist");
    }
    [[noreturn]] void throw_missing(const std::string& text) const {
        mesh_.file.fail(0, "the mesh consists of points, faces, owner and boundary, but " + text);
    }

    std::int64_t n_faces() const { return static_cast<std::int64_t>(start_.size()) - 1; }
    std::int64_t corners(std::int64_t face) const {
        return start_[static_cast<std::size_t>(face) + 1] - start_[static_cast<std::size_t>(face)];
    }
    std::int32_t point(std::int64_t face, std::int64_t k) const {
        return static_cast<std::int32_t>(
            points_[static_cast<std::size_t>(start_[static_cast<std::size_t>(face)] + k)]);
    }

    void check(const TextFile& faces, const std::vector<std::size_t>& offsets,
               const TextFile& owners) const {
        for (std::int64_t face = 0; face < n_faces(); ++face) {
            const std::size_t offset = offsets[static_cast<std::size_t>(face)];
            if (corners(face) < 3)
                faces.fail(offset, "face " + std::to_string(face) + " has fewer than 3 points");
            for (std::int64_t k = 0; k < corners(face); ++k) {
                const std::int64_t number =
                    points_[static_cast<std::size_t>(start_[static_cast<std::size_t>(face)] + k)];
                if (number >= 0 && number < space_.points.points()) continue;
                faces.fail(offset, "face " + std::to_string(face) + " has point " +
                                       std::to_string(number) + ", but there are " +
                                       plural(space_.points.points(), "point"));
            }
        }
        if (static_cast<std::int64_t>(owner_.size()) != n_faces()) {
            const std::string faces_there = plural(n_faces(), "face"),
                              found = std::to_string(owner_.size());
            owners.fail(owners.text().size(),
                        "the file must have the owners of " + faces_there + ", but has " + found);
        }
        for (const std::int64_t cell : owner_) {
            if (cell < 0 || cell >= n_faces())
                owners.fail(0, "cell " + std::to_string(cell) + " owns a face, but cannot exist");
        }
    }

    // Returns the faces of one plane. Patches of type empty hold both planes, which have no point
    // in common. The first patch of type wedge is one plane; the second one may share the axis.
    std::vector<std::int64_t> plane_faces(const TextFile& boundary) {
        std::vector<std::int64_t> empty;
        const Patch* wedge = nullptr;
        for (const Patch& patch : patches_) {
            if (patch.type == "wedge" && patch.n_faces > 0 && wedge == nullptr) wedge = &patch;
            for (std::int64_t i = 0; patch.type == "empty" && i < patch.n_faces; ++i)
                empty.push_back(patch.start_face + i);
        }
        std::vector<std::int64_t> plane;
        if (wedge != nullptr) {
            space_.kind = HM_WEDGE;
            for (std::int64_t i = 0; i < wedge->n_faces; ++i)
                plane.push_back(wedge->start_face + i);
        } else if (!empty.empty()) {
            space_.kind = HM_PLANES;
            plane = one_side(empty);
        } else {
            boundary.fail(0, "no patch has the type empty or wedge: the mesh has three dimensions");
        }
        if (static_cast<std::int64_t>(plane.size()) != n_cells_) {
            boundary.fail(wedge != nullptr ? wedge->offset : 0,
                          "a plane of type " + std::string(wedge != nullptr ? "wedge" : "empty") +
                              " has " + plural(static_cast<std::int64_t>(plane.size()), "face") +
                              ", but the mesh has " + plural(n_cells_, "cell") +
                              ": it is not one cell thick");
        }
        return plane;
    }

    // Returns the faces of one of the two planes, from the faces of both. The planes have no common
    // point, and each cell has one face in each plane.
    std::vector<std::int64_t> one_side(const std::vector<std::int64_t>& faces) const {
        std::vector<std::int32_t> parent(space_.points.x[0].size());
        std::iota(parent.begin(), parent.end(), 0);
        const auto root = [&parent](std::int32_t at) {
            while (parent[static_cast<std::size_t>(at)] != at) {
                std::int32_t& up = parent[static_cast<std::size_t>(at)];
                up = parent[static_cast<std::size_t>(up)];
                at = up;
            }
            return at;
        };
        for (const std::int64_t face : faces) {
            for (std::int64_t k = 1; k < corners(face); ++k) {
                parent[static_cast<std::size_t>(root(point(face, k)))] = root(point(face, 0));
            }
        }
        std::vector<std::int64_t> of_cell(static_cast<std::size_t>(n_cells_), -1), side;
        std::vector<char> taken(parent.size(), 0);  // 1: this plane; 2: the opposite plane
        for (const std::int64_t face : faces) {
            const auto cell = static_cast<std::size_t>(owner_[static_cast<std::size_t>(face)]);
            char& plane = taken[static_cast<std::size_t>(root(point(face, 0)))];
            if (of_cell[cell] < 0) {
                if (plane == 0) plane = 1;
                of_cell[cell] = face;
            } else {
                const char other = taken[static_cast<std::size_t>(root(point(of_cell[cell], 0)))];
                if (plane == 0) plane = other == 1 ? 2 : 1;
            }
        }
        for (const std::int64_t face : faces) {
            if (taken[static_cast<std::size_t>(root(point(face, 0)))] == 1) side.push_back(face);
        }
        return side;
    }

    void add_plane_face(std::int64_t face) {
        std::vector<std::int32_t> face_points;
        for (std::int64_t k = 0; k < corners(face); ++k) face_points.push_back(point(face, k));
        space_.add_face(face_points,
                        space_.points.offset[0][static_cast<std::size_t>(face_points[0])]);
    }

    void add_sides() {
        for (const Patch& patch : patches_) {
            if (patch.type == "empty" || patch.type == "wedge" || patch.n_faces == 0) continue;
            const std::int32_t marker = mesh_.add_marker(patch.name);
            for (std::int64_t i = 0; i < patch.n_faces; ++i) {
                const std::int64_t face = patch.start_face + i;
                if (corners(face) > 4) {
                    const std::string place =
                        "face " + std::to_string(face) + " of the patch " + in_quotes(patch.name);
                    mesh_.file.fail(0, place +
                                           " does not reach from one plane to the other: "
                                           "the mesh is not one cell thick");
                }
                for (std::int64_t k = 0; k < 4; ++k) {
                    space_.side_points.push_back(point(face, std::min(k, corners(face) - 1)));
                }
                space_.side_markers.push_back(marker);
                space_.side_offset.push_back(
                    space_.points.offset[0][static_cast<std::size_t>(point(face, 0))]);
            }
        }
    }

    // Adds pairs of patches that name each other as neighbours across a sliding interface.
    void add_interfaces() {
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            for (std::size_t k = i + 1; k < patches_.size(); ++k) {
                const Patch &one = patches_[i], &other = patches_[k];
                if (one.type != "cyclicAMI" || other.type != "cyclicAMI" || one.n_faces == 0 ||
                    other.n_faces == 0 || one.neighbour != other.name ||
                    other.neighbour != one.name)
                    continue;
                mesh_.interfaces.emplace_back(one.name, other.name);
            }
        }
    }

    Mesh& mesh_;
    std::string folder_;
    SpaceMesh space_;
    std::vector<std::int64_t> start_, points_, owner_;
    std::vector<Patch> patches_;
    std::int64_t n_cells_ = 0;
};

bool probe_openfoam(const TextFile& file) {
    FoamHeader header;
    return read_foam_header(file, header);
}

void read_openfoam(Mesh& mesh, const ReadOptions&) { PolyMesh(mesh).read(); }

}  // namespace

const Format openfoam_format = {"openfoam",
                                "points",
                                "OpenFOAM polyMesh, one cell thick: empty planes or a wedge pair",
                                probe_openfoam,
                                read_openfoam,
                                nullptr};

}  // namespace cli
