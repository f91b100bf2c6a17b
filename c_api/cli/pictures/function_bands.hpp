// Draws a function in colours: one colour between two neighbouring multiples of a step.
#pragma once

#include "mesh/mesh_file.hpp"
#include "pictures/plot.hpp"

#include <string>

namespace cli {

// The multiples of the step that a picture needs, and the colours between them.
struct Bands {
    double step;
    std::int32_t first, last;

    Bands(double low, double high);  // makes ten to twenty bands between these values
    std::int32_t count() const { return last - first; }
    // Returns the value at which the band begins.
    double level(std::int32_t band) const { return (first + band) * step + 0.0; }
    std::string colour(std::int32_t band) const;
};

// values: at the mesh points. Returns a note if the function is drawn as a raster, or "".
std::string paint_function(Plot& plot, const Mesh& mesh, const std::vector<double>& values,
                           const Bands& bands);

// Draws the colour bar at the right of the frames, with the name of the quantity along the bar.
void draw_colour_bar(Sheet& sheet, const Bands& bands, const std::string& name);
constexpr double colour_bar_width = 108;  // width beside the frames [pixels]

}  // namespace cli
