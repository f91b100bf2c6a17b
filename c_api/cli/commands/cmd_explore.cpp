// harmorph explore: writes a page for any browser, on which control points can be dragged.
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"
#include "page/page_data.hpp"
#include "page/page_text.hpp"
#include "work/moves_file.hpp"
#include "work/read_mesh.hpp"

#include <algorithm>
#include <ostream>
#include <sstream>

namespace cli {

namespace {

// The page computes admissible steps, which only a valid mesh has.
void refuse_inverted_cells(const Mesh& mesh, const Basis& basis) {
    const hm_mesh view = mesh.view();
    auto quality = sized<hm_quality_report>();
    call(mesh, hm_assess, basis.get(), &view, nullptr, nullptr, nullptr, nullptr, nullptr,
         &quality);
    if (quality.inverted == 0) return;
    const std::size_t line = mesh.cell_offset[static_cast<std::size_t>(quality.first_inverted)];
    throw Failure(exit_unusable, mesh.file.path() + " has " +
                                     plural(quality.inverted, "inverted cell") + ", the first at " +
                                     mesh.file.place(line));
}

// Returns the default number of points of a page. A processor without a graphics card draws 200000
// points in 0.1 s; 8 million numbers of functions take 43 megabytes.
std::int32_t default_points(const Basis& basis) {
    const double per_point =
        static_cast<double>(basis.functions()) * basis.info().numbers_per_value;
    return static_cast<std::int32_t>(std::clamp(8e6 / per_point, 50000., 200000.));
}

}  // namespace

void run_explore(const Arguments& arguments) {
    const std::string path = arguments.text("-o");
    const std::int32_t wished = arguments.whole("--points", 0, 100, 2000000);
    const Mesh mesh = read_mesh(arguments, 0);
    const Basis basis(arguments.operand(1), mesh);
    refuse_inverted_cells(mesh, basis);
    std::string moves;
    if (arguments.has("--move")) {
        const TextFile text = text_of_moves(arguments.text("--move"));
        const std::vector<double> by = read_moves({text}, movable_of(basis), mesh);
        std::ostringstream lines;  // the page cannot read movements of sections
        if (has_section_movements(text)) write_moves(lines, by, basis, mesh);
        else lines << text.text();
        moves = lines.str();
    }
    const hm_basis_info& info = basis.info();
    const std::vector<std::int32_t> body(info.curve_point, info.curve_point + info.curve_points);
    const PageSelection selection =
        select_for_page(mesh, body, wished > 0 ? wished : default_points(basis));
    OutputFiles files;
    std::ostream& out = files.add(path);
    out << page_head << explore_page.before_data << "<script>\nconst page_data = ";
    write_page_data(out, mesh, basis, selection, moves);
    out << ";\n</script>\n" << explore_page.after_data;
    const double megabytes = static_cast<double>(out.tellp()) / 1e6;
    files.commit();
    print("%s: %s megabytes; open it in a browser\n", path.c_str(), brief(megabytes).c_str());
    const auto n_cells = static_cast<std::int32_t>(selection.cells.size());
    if (n_cells < mesh.cells()) {
        print(
            "left out: %d of %d cells, far from the moving walls, are drawn coarsened and not "
            "judged "
            "(see --points)\n",
            mesh.cells() - n_cells, mesh.cells());
    }
}

}  // namespace cli
