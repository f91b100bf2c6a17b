#include "basics/numbers.hpp"
#include "curves/cad_curves.hpp"

#include <ostream>

namespace cli {

namespace {

// Writes name = values, with at most `per_line` values in each line.
template <class Values, class Text>
void put(std::ostream& out, const char* name, const Values& values, std::size_t per_line,
         Text text) {
    out << "  " << name << " =";
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % per_line == 0) out << "\n   ";
        out << ' ' << text(values[i]) << (i + 1 < values.size() ? "," : "");
    }
    out << '\n';
}

}  // namespace

void write_namelist(std::ostream& out, const Curves& curves) {
    const auto number = [](std::int32_t value) { return std::to_string(value); };
    const auto from_1 = [](std::int32_t index) { return std::to_string(index + 1); };
    out << "&control_points\n  n = " << curves.points() << '\n';
    put(out, "xy", curves.control, 2, exact);
    if (!curves.weights.empty()) put(out, "weights", curves.weights, 1, exact);
    out << "/\n";
    for (const Curve& curve : curves.curves) {
        out << "&curve\n  degree = " << number(curve.degree) << "\n  closed = '"
            << closed_name(curve.closed) << "'\n"
            << "  n_indices = " << curve.indices.size() << '\n';
        put(out, "indices", curve.indices, 10, from_1);
        put(out, "knots", curve.knots, 1, exact);
        out << "/\n";
    }
}

}  // namespace cli
