#include <harmorph_design.h>
#include "basics/csv.hpp"

#include "basics/csv_cells.hpp"
#include "basics/library.hpp"
#include "basics/numbers.hpp"
#include "pictures/draw_curves.hpp"

#include <ostream>

namespace cli {

void write_csv(std::ostream& out, const Mesh& mesh, const std::vector<Column>& columns) {
    out << "point,x,y";
    for (const Column& column : columns) out << ',' << csv_cell(column.name);
    out << '\n';
    for (std::size_t point = 0; point < mesh.x.size(); ++point) {
        out << point << ',' << exact(mesh.x[point]) << ',' << exact(mesh.y[point]);
        for (const Column& column : columns) out << ',' << exact(column.values[point]);
        out << '\n';
    }
}

void write_contours_csv(std::ostream& out, const std::vector<std::vector<ContourLine>>& panels,
                        double step) {
    out << "panel,value,line,x,y\n";
    for (std::size_t panel = 0; panel < panels.size(); ++panel) {
        for (std::size_t line = 0; line < panels[panel].size(); ++line) {
            const ContourLine& contour = panels[panel][line];
            for (const Point& point : contour.points) {
                out << panel + 1 << ',' << brief(contour.multiple * step + 0.0) << ',' << line + 1
                    << ',' << exact(point.x) << ',' << exact(point.y) << '\n';
            }
        }
    }
}

void write_moved_curves_csv(std::ostream& out, const Mesh& mesh, const Basis& basis,
                            const Morph& morph) {
    const hm_curves& before = basis.curves();
    const std::vector<double> control = morph.moved_control(basis);
    hm_curves after = before;
    after.control = control.data();
    const auto pair = [&out](double x, double y) { out << ',' << exact(x) << ',' << exact(y); };
    out << "what,curve,number,u,x,y,moved_x,moved_y\n";
    for (std::int32_t curve = 0; curve < before.n_curves; ++curve) {
        for (const double u : sample_parameters(before.curve[curve])) {
            out << "curve," << curve + 1 << ",," << exact(u);
            for (const hm_curves* curves : {&before, static_cast<const hm_curves*>(&after)}) {
                double xy[2];
                call(std::string("curve"), hm_curve_point, curves, curve, u, 0, xy);
                pair(xy[0], xy[1]);
            }
            out << '\n';
        }
    }
    for (std::int32_t i = 0; i < before.n_control; ++i) {
        out << "control,," << i + 1 << ',';
        pair(before.control[2 * i], before.control[2 * i + 1]);
        pair(after.control[2 * i], after.control[2 * i + 1]);
        out << '\n';
    }
    const hm_basis_info& info = basis.info();
    for (std::int32_t k = 0; k < info.curve_points; ++k) {
        const auto point = static_cast<std::size_t>(info.curve_point[k]);
        const bool on_curve = info.point_curve[k] < info.curves;
        out << "mesh," << (on_curve ? std::to_string(info.point_curve[k] + 1) : "") << ',' << point
            << ',' << (on_curve ? exact(info.point_u[k]) : "");
        pair(mesh.x[point], mesh.y[point]);
        pair(morph.moved.x[point], morph.moved.y[point]);
        out << '\n';
    }
}

}  // namespace cli
