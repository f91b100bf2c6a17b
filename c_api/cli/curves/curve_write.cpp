#include "basics/numbers.hpp"
#include "curves/curve_file.hpp"

#include <ostream>

namespace cli {

namespace {

void write_numbers(std::ostream& out, const char* keyword, const std::vector<double>& values) {
    out << keyword << ' ' << values.size() << '\n';
    for (const double value : values) out << exact(value) << '\n';
}

void write_points(std::ostream& out, const Curves& curves) {
    out << "points " << curves.points() << '\n';
    for (std::size_t i = 0; i < curves.control.size(); i += 2) {
        out << exact(curves.control[i]) << ' ' << exact(curves.control[i + 1]) << '\n';
    }
    if (!curves.weights.empty()) write_numbers(out, "weights", curves.weights);
}

void write_indices(std::ostream& out, const Curve& curve) {
    out << "indices " << curve.indices.size() << '\n';
    for (const std::int32_t index : curve.indices) out << index + 1 << '\n';
}

}  // namespace

void write_curves(std::ostream& out, const Curves& curves) {
    out << "# B-spline; control points are numbered from 1 in this order\n";
    for (const Curve& curve : curves.curves) {
        const bool first = &curve == &curves.curves.front();
        if (!first) out << "curve\n";
        out << "degree " << curve.degree << "\nclosed " << closed_name(curve.closed) << '\n';
        if (first) write_points(out, curves);
        if (curve.indices != default_indices(curves.points(), curve.degree, curve.closed))
            write_indices(out, curve);
        write_numbers(out, "knots", curve.knots);
    }
}

}  // namespace cli
