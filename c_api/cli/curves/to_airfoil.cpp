#include <harmorph_design.h>
#include "curves/to_airfoil.hpp"

#include "basics/library.hpp"
#include "basics/numbers.hpp"

namespace cli {

ToAirfoil fit_to_airfoil(const Basis& basis, std::int32_t curve, const Section& section,
                         const std::string& path, bool on_chord) {
    const auto n = static_cast<std::int32_t>(section.x.size());
    const hm_points points = {section.x.data(), section.y.data(), 1};
    ToAirfoil result;
    result.moves.resize(2 * static_cast<std::size_t>(basis.functions()));
    auto report = sized<hm_refit_report>();
    std::size_t bytes = 0;
    call(path, hm_refit_size, &basis.curves(), curve, n, &bytes);
    Block work(bytes);
    call(path, hm_refit, &basis.curves(), curve, &points, n, std::int32_t{section.is_loop},
         std::int32_t{on_chord}, result.moves.data(), &report, work.data(), bytes);
    result.closed_width = report.closed_width;
    result.points = n;
    result.max_error = report.max_error;
    result.rms_error = report.rms_error;
    result.worst_point = report.max_error_point + 1;
    result.chord = report.chord;
    return result;
}

ToAirfoil moves_to_airfoil(const Basis& basis, std::int32_t curve, const Section& section,
                           const std::string& path, bool on_chord) {
    const ToAirfoil result = fit_to_airfoil(basis, curve, section, path, on_chord);
    if (result.closed_width > 0) {
        warn(path + ": the blunt base, " + brief(result.closed_width) +
             " wide, becomes one point, because the airfoil of the mesh has a sharp trailing edge: "
             "the thickness is reduced linearly from the leading to the trailing edge");
    }
    return result;
}

}  // namespace cli
