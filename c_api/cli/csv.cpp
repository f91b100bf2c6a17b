#include "csv.hpp"

#include "numbers.hpp"

#include <ostream>

namespace cli {

void write_csv(std::ostream& out, const Mesh& mesh, const std::vector<Column>& columns) {
    out << "point,x,y";
    for (const Column& column : columns) out << ',' << column.name;
    out << '\n';
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        out << point << ',' << exact(mesh.x[point]) << ',' << exact(mesh.y[point]);
        for (const Column& column : columns) out << ',' << exact(column.values[point]);
        out << '\n';
    }
}

} // namespace cli
