#include "mesh/marker_names.hpp"

#include "basics/numbers.hpp"

#include <algorithm>
#include <numeric>

namespace cli {

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

}  // namespace cli
