// Checksums that recognise a damaged basis, and fingerprints that recognise the mesh of a basis.
// tests/basis/test_refused_bases.cpp covers this file.
#include <cstddef>

#include "base/hash.hpp"
#include "basis/basis.hpp"

namespace harmorph {
namespace {

// Calls visit(cell) for triangles and quads that together have all corners of cell i, in any
// layout. A cell with at most four corners is visited itself.
template <class Visit>
void for_each_section(Mesh const& mesh, Index i, Visit visit) noexcept {
    if (mesh.layout != CellLayout::polygons) return visit(mesh.cell(i));
    const Index* const corner = mesh.cell_points + (Offset{mesh.cell_start[i]} - mesh.index_base);
    Index const n = mesh.cell_start[i + 1] - mesh.cell_start[i];
    auto const at = [&](Index k) { return from_zero(corner[k], mesh.index_base); };
    for (Index k = 1; k + 1 < n; k += 2) {
        visit(k + 2 < n ? Cell{4, {at(0), at(k), at(k + 1), at(k + 2)}}
                        : Cell{3, {at(0), at(k), at(k + 1)}});
    }
}

std::uint64_t pair(Index a, Index b) noexcept {
    return static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
}

}  // namespace

std::uint64_t checksum_of(BasisHeader const& header, Executor const& executor) noexcept {
    Size const covered_from = offsetof(BasisHeader, checksum) + sizeof header.checksum;
    const unsigned char* const block = reinterpret_cast<const unsigned char*>(&header);
    return hash_of_block(block + covered_from, static_cast<Size>(header.bytes) - covered_from,
                         executor);
}

MeshFingerprint fingerprint_of(Mesh const& mesh) noexcept {
    Hash front, back;
    front.add(pair(mesh.n_points, mesh.n_cells));
    auto const add = [&](Cell const& cell) {
        front.add(pair(cell.point[0], cell.point[1]));
        back.add(pair(cell.point[2], cell.n == 4 ? cell.point[3] : none));
    };
    if (mesh.layout == CellLayout::polygons) {
        for (Index i = 0; i < mesh.n_cells; ++i) for_each_section(mesh, i, add);
    } else {
        mesh.for_each_cell([&](Index, Cell const& cell) { add(cell); });
    }
    front.add(back.value());
    std::uint64_t sum = 0;  // The sum does not depend on the order of the faces.
    mesh.for_each_face([&](BoundaryFace const& face, Index, Index) {
        Hash face_hash;
        face_hash.add(pair(min(face.begin, face.end), max(face.begin, face.end)));
        face_hash.add(static_cast<std::uint32_t>(face.marker));
        sum += face_hash.value();
        return true;
    });
    return {front.value(), sum, sample_of(mesh)};
}

std::uint64_t sample_of(Mesh const& mesh) noexcept {
    Index const n = min(Index{64}, mesh.n_cells);
    Hash hash;
    for (Index k = 0; k < n; ++k) {
        for_each_section(mesh, static_cast<Index>(Offset{k} * mesh.n_cells / n),
                         [&](Cell const& cell) {
                             hash.add(pair(cell.point[0], cell.point[1]));
                             hash.add(pair(cell.point[2], cell.n == 4 ? cell.point[3] : none));
                         });
    }
    return hash.value();
}

std::uint64_t coordinates_fingerprint(Points points, Index n_points) noexcept {
    Hash x, y;
    for (Index k = 0; k < n_points; ++k) {
        x.add(bits_of(points[k].x));
        y.add(bits_of(points[k].y));
    }
    x.add(y.value());
    return x.value();
}

}  // namespace harmorph
