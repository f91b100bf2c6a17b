// A grid of pixels over a frame, for pictures of too many cells for a file of shapes. Each pixel
// has one value, and neighbours in a row with equal shades become one rectangle.
#pragma once

#include "pictures/svg.hpp"

#include <array>
#include <limits>
#include <vector>

namespace cli {

class Raster {
public:
    static constexpr double nothing = std::numeric_limits<double>::infinity();

    explicit Raster(const Box& frame);

    // Sets the values of a linear function at the pixels whose centres lie in the triangle, which
    // is given in pixels of the sheet.
    void fill(const std::array<Point, 3>& corners, const std::array<double, 3>& values);
    std::size_t columns() const { return columns_; }
    std::size_t rows() const { return rows_; }
    // Returns `nothing` if the pixel is not filled.
    double at(std::size_t column, std::size_t row) const { return value_[row * columns_ + column]; }

    // Adds all pixels to paths, one for each shade. shade_of(column, row): an index of `paths`, or
    // -1 if the pixel is not drawn.
    template <class ShadeOf>
    void runs(std::vector<SvgPath>& paths, ShadeOf shade_of) const {
        for (std::size_t row = 0; row < rows_; ++row) {
            for (std::size_t begin = 0, end = 0; begin < columns_; begin = end) {
                const int shade = shade_of(begin, row);
                for (end = begin + 1; end < columns_ && shade_of(end, row) == shade;) ++end;
                if (shade < 0) continue;
                const Point low = {frame_.low.x + static_cast<double>(begin),
                                   frame_.low.y + static_cast<double>(row)};
                paths[static_cast<std::size_t>(shade)].rectangle(
                    {low, {low.x + static_cast<double>(end - begin), low.y + 1}});
            }
        }
    }

private:
    Box frame_;
    std::size_t columns_, rows_;
    std::vector<double> value_;
};

}  // namespace cli
