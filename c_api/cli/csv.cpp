#include "csv.hpp"

#include "numbers.hpp"

#include <ostream>

namespace cli {

void write_csv(std::ostream& out, const Mesh& mesh, const std::vector<double>& values) {
    out << "point,x,y,value\n";
    for (std::size_t point = 0; point < values.size(); ++point) {
        out << point << ',' << exact(mesh.x[point]) << ',' << exact(mesh.y[point]) << ',' << exact(values[point]) << '\n';
    }
}

} // namespace cli
