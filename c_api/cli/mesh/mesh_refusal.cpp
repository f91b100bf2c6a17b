// Errors of the library about a mesh, as sentences with the line of the mesh file.
#include "basics/library.hpp"
#include "basics/text.hpp"
#include "mesh/mesh_file.hpp"

namespace cli {

namespace {

// Returns the offset of an item in the file of the mesh, or nullptr if the item is not in the file.
const std::size_t* offset_of(std::int32_t kind, std::int32_t item, const Mesh& mesh) {
    const std::vector<std::size_t>* offsets = nullptr;
    if (kind == HM_ITEM_CELL) offsets = &mesh.cell_offset;
    if (kind == HM_ITEM_SIDE) offsets = &mesh.face_offset;
    if (kind == HM_ITEM_POINT) offsets = &mesh.point_offset;
    if (offsets == nullptr || item < 0) return nullptr;
    const auto number = static_cast<std::size_t>(item);
    return number < offsets->size() ? &(*offsets)[number] : nullptr;
}

// Returns the line of the first of the error's items that is in the file, or the path alone.
std::string place_of(const hm_error& error, const Mesh& mesh) {
    const std::size_t* offset = offset_of(error.item_kind, error.item - error.item_base, mesh);
    if (offset == nullptr)
        offset = offset_of(error.other_kind, error.other - error.other_base, mesh);
    return offset != nullptr ? mesh.file.place(*offset) : mesh.file.path();
}

// The library knows the numbers of markers only; returns text such as " (marker 4 is 'axis')".
std::string names_of_markers(const hm_error& error, const Mesh& mesh) {
    std::string text;
    const auto add = [&](std::int32_t kind, std::int32_t number) {
        if (kind != HM_ITEM_MARKER || number < 0) return;
        const auto marker = static_cast<std::size_t>(number);
        if (marker >= mesh.markers.size()) return;
        text += (text.empty() ? " (marker " : ", marker ") + std::to_string(number) + " is " +
                in_quotes(mesh.markers[marker]);
    };
    add(error.item_kind, error.item);
    add(error.other_kind, error.other);
    return text.empty() ? text : text + ")";
}

}  // namespace

void refuse(const hm_error& error, const Mesh& mesh) {
    const bool of_the_mesh = error.code == HM_BAD_MESH || error.code == HM_NOT_POSITIVE ||
                             error.code == HM_BAD_CONDITION;
    const std::string place = of_the_mesh ? place_of(error, mesh) + ": " : std::string();
    const bool is_likely = error.code == HM_BAD_MESH && !mesh.likely_fault.empty();
    const std::string fault = is_likely ? "; " + mesh.likely_fault : std::string();
    throw Failure(exit_code(error.code),
                  place + error.text + names_of_markers(error, mesh) + fault);
}

}  // namespace cli
