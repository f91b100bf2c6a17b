#include "work/flux_file.hpp"

#include "basics/geometry.hpp"
#include "basics/numbers.hpp"
#include "files/text_file.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace cli {

void FluxList::give_to(hm_problem& problem) const {
    problem.n_fluxes = static_cast<std::int32_t>(points.size() / 2);
    problem.flux_points = points.data();
    problem.fluxes = values.data();
}

FluxList read_fluxes(const std::string& path, const Mesh& mesh, std::int32_t n_control) {
    const TextFile file(path);
    LineReader lines(file, '#');
    FluxList list;
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> face_of;
    std::set<std::pair<std::size_t, std::int32_t>> named;
    while (lines.next()) {
        const auto& words = lines.words();
        if (words.size() != 4) lines.expected("point point control-point value");
        std::int32_t ends[2] = {0, 0}, control = 0;
        for (const std::size_t i : {0, 1}) {
            if (!parse(words[i], ends[i]) || ends[i] < 0 || ends[i] >= mesh.points()) {
                lines.expected("a point between 0 and " + std::to_string(mesh.points() - 1),
                               words[i]);
            }
        }
        if (!parse(words[2], control) || control < 1 || control > n_control) {
            lines.expected("a control point between 1 and " + std::to_string(n_control), words[2]);
        }
        double value = 0;
        if (!parse(words[3], value)) lines.expected("a finite number", words[3]);
        const auto [found, is_new] =
            face_of.emplace(std::minmax(ends[0], ends[1]), list.points.size() / 2);
        if (is_new) {
            list.points.insert(list.points.end(), {ends[0], ends[1]});
            list.values.resize(list.values.size() + place(n_control));
        }
        if (!named.emplace(found->second, control).second)
            lines.fail("the flux of this control point through this face is given twice");
        list.values[found->second * place(n_control) + place(control - 1)] = value;
    }
    return list;
}

}  // namespace cli
