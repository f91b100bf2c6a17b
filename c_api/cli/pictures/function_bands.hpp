// A function in colours: what lies between two neighbouring multiples of a step has one colour.
#pragma once

#include "mesh/mesh_file.hpp"
#include "pictures/plot.hpp"

#include <string>

namespace cli {

// The multiples of the step that a picture needs, first to last, and the colours between them.
struct Bands {
    double step;
    std::int32_t first, last;

    Bands(double low, double high);  // ten to twenty between these values
    std::int32_t count() const { return last - first; }
    double level(std::int32_t band) const {
        return (first + band) * step + 0.0;
    }  // where it begins
    std::string colour(std::int32_t band) const;
};

// values: at the mesh's points. Returns what to say of the way of drawing, or "".
std::string paint_function(Plot& plot, const Mesh& mesh, const std::vector<double>& values,
                           const Bands& bands);

// At the right of the frames, with the quantity's name along it.
void draw_colour_bar(Sheet& sheet, const Bands& bands, const std::string& name);
constexpr double colour_bar_width = 108;  // pixels beside the frames

}  // namespace cli
