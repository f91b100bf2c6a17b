#include "mesh/mesh_file.hpp"

#include "basics/elementary.hpp"
#include "basics/failure.hpp"
#include "basics/geometry.hpp"
#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "basics/text.hpp"
#include "mesh/loops.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace cli {

std::int32_t Mesh::faces(std::int32_t marker) const {
    return static_cast<std::int32_t>(std::count(face_markers.begin(), face_markers.end(), marker));
}

hm_mesh Mesh::view() const {
    hm_mesh mesh = {};
    mesh.struct_size = sizeof mesh;
    mesh.n_points = points();
    mesh.points = coordinates();
    mesh.cell_layout = has_polygons ? HM_CELLS_POLYGONS : HM_CELLS_ROWS;
    mesh.n_cells = cells();
    mesh.cell_start = cell_start.data();
    mesh.cell_points = cell_points.data();
    mesh.n_faces = faces();
    mesh.face_points = face_points.data();
    mesh.face_markers = face_markers.data();
    return mesh;
}

std::int32_t Mesh::add_marker(std::string_view tag) {
    if (marker_numbers_.size() != markers.size()) {  // markers were dropped, or renumbered
        marker_numbers_.clear();
        for (std::size_t marker = 0; marker < markers.size(); ++marker)
            marker_numbers_.emplace(markers[marker], static_cast<std::int32_t>(marker));
    }
    const auto next = static_cast<std::int32_t>(markers.size());
    const auto known = marker_numbers_.emplace(std::string(tag), next);
    if (known.second) markers.emplace_back(tag);
    return known.first->second;
}

void Mesh::remark(const std::string& text) {
    constexpr std::size_t max_remarks = 100;  // each remark is compared with all earlier ones
    if (remarks.size() >= max_remarks) return;
    if (std::find(remarks.begin(), remarks.end(), text) == remarks.end()) remarks.push_back(text);
}

void Mesh::remark_ignored(const std::string& contents) {
    remark("ignored, but kept in a morphed mesh of the same format: " + contents);
}

void Mesh::add_point(double point_x, double point_y, std::size_t x_offset) {
    x.push_back(point_x);
    y.push_back(point_y);
    point_offset.push_back(x_offset);
}

void Mesh::refuse_polygons(const std::string& who) const {
    for (std::size_t cell = 0; cell + 1 < cell_start.size(); ++cell) {
        if (cell_start[cell + 1] - cell_start[cell] <= 4) continue;
        throw Failure(exit_usage, file.path() +
                                      " has cells of more than four corners (the first is cell " +
                                      std::to_string(cell) + "), but " + who +
                                      " takes triangles and quadrilaterals only");
    }
}

void Mesh::find_polygons() {
    const auto at = [this](std::int32_t i) {
        return static_cast<std::size_t>(cell_points[static_cast<std::size_t>(i)]);
    };
    for (std::size_t cell = 0; cell + 1 < cell_start.size() && !has_polygons; ++cell) {
        const std::int32_t first = cell_start[cell], n = cell_start[cell + 1] - first;
        has_polygons = n > 4;
        double min_turn = 0, max_turn = 0;  // sines of the turns at the corners
        for (std::int32_t k = 0; k < n && n == 4; ++k) {
            const std::size_t a = at(first + k), b = at(first + (k + 1) % n),
                              c = at(first + (k + 2) % n);
            const double ux = x[b] - x[a], uy = y[b] - y[a], vx = x[c] - x[b], vy = y[c] - y[b];
            const double size = length_of(ux, uy) * length_of(vx, vy);
            const double turn = size > 0 ? (ux * vy - uy * vx) / size : 0;
            min_turn = k == 0 ? turn : std::min(min_turn, turn);
            max_turn = k == 0 ? turn : std::max(max_turn, turn);
        }
        constexpr double flat = 1e-6;
        has_polygons = has_polygons || (n == 4 && min_turn < flat && max_turn > -flat);
    }
}

void Mesh::add_face(std::int32_t a, std::int32_t b, std::int32_t marker, std::size_t offset) {
    face_points.insert(face_points.end(), {a, b});
    face_markers.push_back(marker);
    face_offset.push_back(offset);
}

// Finds markers by names, patterns with * and ?, and whole loops of the boundary.

namespace {

constexpr std::string_view loop_prefix = "loop:";
constexpr std::size_t max_listed = 12;  // largest number of names in a message

// In a pattern, * matches any characters, and ? matches one character.
bool matches(std::string_view pattern, std::string_view name) {
    std::size_t p = 0, n = 0, star = pattern.npos, from = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            from = n;
        } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p;
            ++n;
        } else if (star != pattern.npos) {
            p = star + 1;
            n = ++from;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == pattern.npos;
}

class Selection {
public:
    explicit Selection(const Mesh& mesh) : mesh_(mesh), faces_(mesh.markers.size()) {
        for (const std::int32_t marker : mesh.face_markers) ++faces_[place(marker)];
    }

    bool is_known(std::string_view name) const {
        return number_of(name) >= 0 || mesh_.groups.count(std::string(name));
    }

    std::vector<std::int32_t> find(std::string_view name, bool is_literal) const {
        std::set<std::int32_t> found;
        add_named(std::string(name), found);
        std::int32_t loop = 0;
        if (found.empty() && is_literal) refuse(name);
        if (found.empty() && name.substr(0, loop_prefix.size()) == loop_prefix &&
            parse(name.substr(loop_prefix.size()), loop)) {
            add_loop(loop, found);
        }
        if (found.empty() && name.find_first_of("*?") != name.npos) add_matching(name, found);
        if (found.empty()) refuse(name);
        return {found.begin(), found.end()};
    }

private:
    std::int32_t number_of(std::string_view name) const {
        const auto found = std::find(mesh_.markers.begin(), mesh_.markers.end(), name);
        return found == mesh_.markers.end()
                   ? -1
                   : static_cast<std::int32_t>(found - mesh_.markers.begin());
    }

    void add_named(const std::string& name, std::set<std::int32_t>& found) const {
        const std::int32_t marker = number_of(name);
        const auto group = mesh_.groups.find(name);
        if (marker >= 0 && faces_[place(marker)] > 0) found.insert(marker);
        for (std::size_t k = 0; group != mesh_.groups.end() && k < group->second.size(); ++k) {
            const std::int32_t member = number_of(group->second[k]);
            if (member >= 0 && faces_[place(member)] > 0) found.insert(member);
        }
        if (marker >= 0 && found.empty()) {
            throw Failure(exit_usage, "marker " + in_quotes(name) + " of " + mesh_.file.path() +
                                          " has no faces");
        }
    }

    void add_loop(std::int32_t number, std::set<std::int32_t>& found) const {
        const BoundaryLoops loops = loops_of(mesh_);
        if (number < 1 || number > loops.count) {
            throw Failure(exit_usage, mesh_.file.path() + " has no loop:" + std::to_string(number) +
                                          ", because the boundary has " +
                                          plural(loops.count, "loop"));
        }
        std::vector<char> is_elsewhere(faces_.size(), 0);
        for (std::size_t face = 0; face < mesh_.face_markers.size(); ++face) {
            const std::int32_t marker = mesh_.face_markers[face];
            if (loops.of_edge[face] + 1 == number) {
                found.insert(marker);
            } else {
                is_elsewhere[place(marker)] = 1;
            }
        }
        for (const std::int32_t marker : found) {
            if (is_elsewhere[place(marker)] == 0) continue;
            const std::string tag = mesh_.markers[place(marker)];
            throw Failure(exit_usage, "marker " + in_quotes(tag) + " of " + mesh_.file.path() +
                                          " has faces on loop:" + std::to_string(number) +
                                          " and on other loops: name its piece, as " +
                                          in_quotes(tag + "@X:Y"));
        }
    }

    void add_matching(std::string_view pattern, std::set<std::int32_t>& found) const {
        for (std::size_t marker = 0; marker < faces_.size(); ++marker) {
            if (faces_[marker] > 0 && matches(pattern, mesh_.markers[marker]))
                found.insert(static_cast<std::int32_t>(marker));
        }
        for (const auto& group : mesh_.groups) {
            if (matches(pattern, group.first)) add_named(group.first, found);
        }
    }

    [[noreturn]] void refuse(std::string_view name) const {
        std::string known;
        for (std::size_t k = 0; k < mesh_.markers.size() && k < max_listed; ++k)
            known += (known.empty() ? "" : ", ") + in_quotes(mesh_.markers[k]);
        if (mesh_.markers.size() > max_listed) {
            known +=
                " and " + std::to_string(mesh_.markers.size() - max_listed) +
                " more; in a name, * matches any characters, and loop:1, loop:2, ... are whole "
                "loops of the boundary";
        }
        throw Failure(exit_usage, mesh_.file.path() + " has no marker " + in_quotes(name) +
                                      (known.empty() ? "; the mesh has no markers"
                                                     : "; the markers of the mesh are " + known) +
                                      did_you_mean(name, mesh_.markers));
    }

    const Mesh& mesh_;
    std::vector<std::int32_t> faces_;  // number of faces of each marker
};

// An entry of a list of markers: a name, which quotes make literal, and the place behind the @.
struct Entry {
    std::string name;
    bool is_literal = false;
    MarkerPiece piece;
};

bool read_place(std::string_view text, MarkerPiece& piece) {
    std::vector<double> place;
    piece.is_piece = parse_list(text, place, ':') && place.size() == 2;
    if (piece.is_piece) piece.x = place[0], piece.y = place[1];
    return piece.is_piece;
}

// Text in quotes is a name in quotes rather than a name that has quotes of its own.
Entry entry_of(const Selection& selection, std::string_view text) {
    Entry entry;
    const std::size_t behind = behind_quoted(text, 0);
    const std::string_view rest = text.substr(behind);
    const bool is_quoted =
        behind > 0 && (rest.empty() || (rest[0] == '@' && read_place(rest.substr(1), entry.piece)));
    if (is_quoted) {
        entry.name = unquoted(text.substr(0, behind));
        entry.is_literal = true;
        if (selection.is_known(entry.name) || !selection.is_known(text)) return entry;
    }
    entry = {std::string(text), selection.is_known(text), {}};
    const std::size_t at = text.rfind('@');
    if (!entry.is_literal && at != text.npos && read_place(text.substr(at + 1), entry.piece))
        entry.name = trimmed(text.substr(0, at));
    return entry;
}

// Calls visit(entry) for each entry of a list. A single name may contain commas.
template <class Visit>
void for_each_entry(const Selection& selection, const std::string& list, const Visit& visit) {
    const Entry whole = entry_of(selection, list);
    if (whole.is_literal) return visit(whole);
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t name = std::min(list.find_first_not_of(blanks, begin), list.size());
        const std::size_t end = std::min(list.find(',', behind_quoted(list, name)), list.size());
        visit(entry_of(selection, trimmed(std::string_view(list).substr(begin, end - begin))));
        begin = end + 1;
    }
}

}  // namespace

std::vector<std::int32_t> Mesh::find_markers(const std::string& list) const {
    std::vector<std::int32_t> found;
    for (const MarkerPiece& piece : find_pieces(list)) {
        if (piece.is_piece)
            throw Failure(exit_usage,
                          "whole markers are expected, not a piece as in " + in_quotes(list));
        found.push_back(piece.marker);
    }
    return found;
}

std::vector<MarkerPiece> Mesh::find_pieces(const std::string& list) const {
    const Selection selection(*this);
    std::vector<MarkerPiece> found;
    for_each_entry(selection, list, [&](const Entry& entry) {
        MarkerPiece piece = entry.piece;
        for (const std::int32_t marker : selection.find(entry.name, entry.is_literal)) {
            piece.marker = marker;
            const bool is_double =
                std::any_of(found.begin(), found.end(), [&](const MarkerPiece& other) {
                    return other.marker == marker && !other.is_piece && !piece.is_piece;
                });
            if (!is_double) found.push_back(piece);
        }
    });
    return found;
}

std::pair<std::string, std::string> Mesh::split_binding(const std::string& binding) const {
    const std::size_t first = equals_behind_names(binding, 0);
    for (std::size_t equals = first; equals != binding.npos;
         equals = equals_behind_names(binding, equals + 1)) {
        if (has_markers(binding.substr(0, equals)))
            return {binding.substr(0, equals), binding.substr(equals + 1)};
    }
    if (first == binding.npos || has_markers(binding)) return {binding, ""};
    return {binding.substr(0, first), binding.substr(first + 1)};
}

bool Mesh::has_markers(const std::string& list) const {
    try {
        find_pieces(list);
        return true;
    } catch (const Failure&) {
        return false;
    }
}

std::string Mesh::name_of(const hm_condition& condition) const {
    const std::string& name = markers[static_cast<std::size_t>(condition.marker)];
    if (condition.piece == 0) return quoted_name(name);
    const std::string near = '@' + exact(condition.near_x) + ':' + exact(condition.near_y);
    // Another marker may have the name of this piece.
    const bool is_taken = std::find(markers.begin(), markers.end(), name + near) != markers.end();
    return quoted_name(name, is_taken) + near;
}

void number_by_name(Mesh& mesh) {
    std::vector<std::size_t> order(mesh.markers.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return mesh.markers[a] < mesh.markers[b]; });
    std::vector<std::int32_t> number(order.size());
    std::vector<std::string> names;
    for (const std::size_t marker : order) {
        number[marker] = static_cast<std::int32_t>(names.size());
        names.push_back(mesh.markers[marker]);
    }
    for (std::int32_t& marker : mesh.face_markers)
        marker = number[static_cast<std::size_t>(marker)];
    mesh.markers = names;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + in_quotes(name);
    return text.empty() ? "no markers" : text;
}

// Errors of the library about a mesh, as sentences with the line of the mesh file.

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
