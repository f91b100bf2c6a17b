// harmorph export: writes functions of a basis as a table, for ParaView, or as a picture.
#include "basics/numbers.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"
#include "formats/vtu.hpp"
#include "options/place_options.hpp"
#include "pictures/contour_lines.hpp"
#include "pictures/pictures.hpp"
#include "work/basis_file.hpp"
#include "work/engine.hpp"
#include "work/mesh_fields.hpp"
#include "work/read_mesh.hpp"
#include "work/solver.hpp"

#include <harmorph_study.h>

#include <memory>
#include <optional>
#include <ostream>
#include <utility>

namespace cli {

namespace {

// Writes contour lines with the columns panel (from 1), value, line (from 1 in each panel), x, y.
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

// Returns the numbers of the values of a function, which are real, complex or 2 x 2 matrices.
std::vector<Column> columns_of(const Basis& basis, const Mesh& mesh, std::int32_t function) {
    static const std::vector<std::string> complex = {"value", "imaginary"},
                                          matrix = {"xx", "xy", "yx", "yy"};
    const std::int32_t numbers = basis.info().numbers_per_value;
    std::vector<Column> columns;
    for (std::int32_t number = 0; number < numbers; ++number) {
        const auto& names = numbers == 4 ? matrix : complex;
        columns.push_back(
            {names[static_cast<std::size_t>(number)], basis.values(function, number, mesh)});
    }
    return columns;
}

PointData point_data(const std::vector<Column>& columns) {
    PointData data = {"function", columns.size(), {}};
    for (std::size_t point = 0; point < columns[0].values.size(); ++point) {
        for (const Column& column : columns) data.values.push_back(column.values[point]);
    }
    return data;
}

// Agglomerates again, as the basis does not keep the levels.
std::vector<Level> levels_of(const Arguments& arguments, const Mesh& mesh, const Basis& basis) {
    Task task = task_of(basis);
    if (task.options.engine != HM_FAS) {
        arguments.refuse(
            "--level needs a basis that the engine fas solved: the other engines have no "
            "agglomerated volumes");
    }
    set_agglomeration(arguments, task.options);
    task.options.levels = 20;
    const Threads threads(1);
    Solver solver(mesh, task, threads);
    solver.prepare();
    call(mesh, hm_plan_factor, solver.plan(), nullptr);
    std::vector<Level> levels;
    for (const std::int32_t number : arguments.whole_list("--level", 0, 19)) {
        levels.emplace_back();
        levels.back().number = number;
        levels.back().cells.resize(mesh.x.size());
        call(mesh, hm_plan_level, solver.plan(), number, levels.back().cells.data(),
             &levels.back().n_cells);
    }
    return levels;
}

void export_levels(const Arguments& arguments) {
    const std::string path = arguments.text("--svg");
    const Mesh mesh = read_mesh(arguments, 0);
    const Basis basis(arguments.operand(1), mesh);
    const std::optional<Box> window = window_of(arguments);
    OutputFiles files;
    files.add(path) << level_picture(mesh, basis.curves(), levels_of(arguments, mesh, basis),
                                     window ? *window : function_window(mesh, basis));
    files.commit();
}

// Adds a panel for each number of each function of one basis.
void add_panels(const Arguments& arguments, const Basis& basis, const Mesh& mesh,
                std::vector<FunctionPanel>& panels) {
    const std::int32_t numbers = basis.info().numbers_per_value;
    std::vector<std::int32_t> shown = {1};
    if (arguments.has("--number")) shown = arguments.whole_list("--number", 1, 4);
    for (const std::int32_t function : arguments.whole_list("--function", 1, basis.functions())) {
        for (const std::int32_t number : shown) {
            if (number <= numbers)
                panels.push_back({&basis, function - 1, number - 1,
                                  basis.values(function - 1, number - 1, mesh)});
        }
    }
}

void write_pictures(const Arguments& arguments, const Mesh& mesh, const Basis& basis,
                    OutputFiles& files) {
    std::vector<std::unique_ptr<Basis>> others;
    std::vector<FunctionPanel> panels;
    add_panels(arguments, basis, mesh, panels);
    for (const std::string& path : arguments.all("--beside")) {
        others.push_back(std::make_unique<Basis>(path, mesh));
        add_panels(arguments, *others.back(), mesh, panels);
    }
    if (panels.empty())
        arguments.refuse("--number " + arguments.text("--number") +
                         " does not exist: no value has so many numbers");
    const std::optional<Box> window = window_of(arguments);
    if (arguments.has("--contour-csv")) {
        const Box box = window ? *window : function_window(mesh, basis);
        const double step = contour_step(mesh, panels, box);
        std::vector<std::vector<ContourLine>> lines;
        for (const FunctionPanel& panel : panels)
            lines.push_back(contour_lines(mesh, panel.values, step, box));
        write_contours_csv(files.add(arguments.text("--contour-csv")), lines, step);
    }
    if (arguments.has("--svg"))
        files.add(arguments.text("--svg")) << function_picture(mesh, std::move(panels), window);
}

}  // namespace

void run_export(const Arguments& arguments) {
    if (arguments.has("--level")) return export_levels(arguments);
    arguments.text("--function");  // refuses a missing option
    if (!arguments.has("--csv") && !arguments.has("--vtu") && !arguments.has("--svg") &&
        !arguments.has("--contour-csv")) {
        arguments.refuse(
            "there is nothing to write; name a file after --csv, --vtu, --svg or --contour-csv");
    }
    const Mesh mesh = read_mesh(arguments, 0);
    const Basis basis(arguments.operand(1), mesh);
    if (basis.mesh_has_moved()) warn("the mesh has moved since the basis was solved");
    const std::vector<std::int32_t> functions =
        arguments.whole_list("--function", 1, basis.functions());
    const bool has_table = arguments.has("--csv") || arguments.has("--vtu");
    if (arguments.has("--number") && !arguments.has("--beside")) {
        const std::int32_t numbers = basis.info().numbers_per_value;
        if (arguments.whole_list("--number", 1, 4)[0] > numbers) {
            arguments.refuse("--number " + arguments.text("--number") +
                             " does not exist: a value of these functions has " +
                             plural(numbers, "number"));
        }
    }
    if (has_table && functions.size() > 1)
        arguments.refuse("--csv and --vtu take exactly one function of --function");
    OutputFiles files;
    if (has_table) {
        const std::vector<Column> columns = columns_of(basis, mesh, functions[0] - 1);
        if (arguments.has("--csv")) write_csv(files.add(arguments.text("--csv")), mesh, columns);
        if (arguments.has("--vtu"))
            write_vtu(files.add(arguments.text("--vtu")), mesh, mesh.x, mesh.y,
                      {point_data(columns)});
    }
    if (arguments.has("--svg") || arguments.has("--contour-csv"))
        write_pictures(arguments, mesh, basis, files);
    files.commit();
}

}  // namespace cli
