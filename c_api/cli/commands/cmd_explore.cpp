// harmorph explore: writes a page for any browser, on which control points can be dragged.
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"
#include "page/explore_data.hpp"
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

// A browser draws 200000 points in 0.1 s, and has 4 gigabytes for the functions of a page.
constexpr std::int32_t most_points = 500000;

void refuse_without_module() {
    if (*page_module != '\0') return;
    throw Failure(exit_unusable, std::string("this program was made without ") + no_page_module +
                                     ", with which pages compute");
}

void refuse_large_mesh(const Mesh& mesh, std::int32_t most) {
    const auto n = static_cast<std::int32_t>(mesh.x.size());
    if (n <= most) return;
    throw Failure(exit_usage, mesh.file.path() + " has " + plural(n, "point") +
                                  ", more than a page is meant for; --points " + std::to_string(n) +
                                  " makes the page all the same");
}

}  // namespace

void run_explore(const Arguments& arguments) {
    const std::string path = arguments.text("-o");
    const std::int32_t most = arguments.whole("--points", most_points, 3, INT32_MAX);
    refuse_without_module();
    const Mesh mesh = read_mesh(arguments, 0);
    refuse_large_mesh(mesh, most);
    const Basis basis(arguments.operand(1), mesh);
    refuse_inverted_cells(mesh, basis);
    if (basis.has_moved_bodies())
        throw Failure(exit_unusable, mesh.file.path() +
                                         ": rigid bodies have moved since the basis was solved, "
                                         "and a page has the bodies of that mesh; solve again on "
                                         "this mesh");
    std::string moves;
    if (arguments.has("--move")) {
        const TextFile text = text_of_moves(arguments.text("--move"));
        const std::vector<double> by = read_moves({text}, movable_of(basis), mesh);
        std::ostringstream lines;  // the page cannot read movements of sections
        if (has_section_movements(text)) write_moves(lines, by, basis, mesh);
        else lines << text.text();
        moves = lines.str();
    }
    OutputFiles files;
    std::ostream& out = files.add(path);
    out << page_head << explore_page.before_data << "<script>\nconst page_module = \""
        << page_module << "\";\nconst page_data = " << explore_data(mesh, basis, moves)
        << ";\n</script>\n"
        << explore_page.after_data;
    const double megabytes = static_cast<double>(out.tellp()) / 1e6;
    files.commit();
    print("%s: %s megabytes; open it in a browser\n", path.c_str(), brief(megabytes).c_str());
}

}  // namespace cli
