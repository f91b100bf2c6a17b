// harmorph export: one function of a basis as a table, for ParaView, or as a picture.
#include "basis_file.hpp"
#include "commands.hpp"
#include "csv.hpp"
#include "draw_curves.hpp"
#include "engine.hpp"
#include "output_file.hpp"
#include "pictures.hpp"
#include "solver.hpp"
#include "vtu.hpp"
#include "window_option.hpp"

#include <cstdio>
#include <ostream>

namespace cli {

namespace {

// The numbers of a function's value: a real one, a complex one or a 2 x 2 matrix.
std::vector<Column> columns_of(const Basis& basis, const Mesh& mesh, std::int32_t function) {
    static const std::vector<std::string> complex = {"value", "imaginary"}, matrix = {"xx", "xy", "yx", "yy"};
    const std::int32_t numbers = basis.info().numbers_per_value;
    std::vector<Column> columns;
    for (std::int32_t number = 0; number < numbers; ++number) {
        const auto& names = numbers == 4 ? matrix : complex;
        columns.push_back({names[static_cast<std::size_t>(number)], basis.values(function, number, mesh)});
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

// The levels are made once more, as the basis does not keep them.
Level level_of(const Arguments& arguments, const Mesh& mesh, const Basis& basis) {
    Task task = task_of(basis);
    if (task.options.engine == HM_DIRECT) arguments.refuse("--level: the basis was solved by the direct engine, without levels");
    set_agglomeration(arguments, task.options);
    task.options.levels = 20;
    const Threads threads(1);
    Solver solver(mesh, task, threads);
    solver.prepare();
    call(mesh, hm_plan_factor, solver.plan(), nullptr);
    Level level;
    level.number = arguments.whole("--level", 1, 0, 19);
    level.cells.resize(mesh.x.size());
    call(mesh, hm_plan_level, solver.plan(), level.number, level.cells.data(), &level.n_cells);
    return level;
}

void export_level(const Arguments& arguments) {
    const std::string path = arguments.text("--svg");
    const Mesh mesh = read_mesh(arguments, 0);
    const Basis basis(arguments.operand(1), mesh);
    OutputFiles files;
    const Box bodies = box_of_bodies(basis.info(), mesh.x, mesh.y);
    const Box window = has_window(arguments) ? window_of(arguments) : window_round({box_of(basis.curves()), bodies}, .4);
    files.add(path) << level_picture(mesh, basis.curves(), level_of(arguments, mesh, basis), window);
    files.commit();
}

void run(const Arguments& arguments) {
    if (arguments.has("--level")) return export_level(arguments);
    arguments.text("--function"); // there is no default
    if (!arguments.has("--csv") && !arguments.has("--vtu") && !arguments.has("--svg")) {
        arguments.refuse("nothing to write: name a file after --csv, --vtu or --svg");
    }
    const Mesh mesh = read_mesh(arguments, 0);
    const Basis basis(arguments.operand(1), mesh);
    if (basis.mesh_has_moved()) warn("the mesh is not where it was when the basis was solved");
    const std::int32_t function = arguments.whole("--function", 1, 1, basis.functions()) - 1;
    const std::vector<Column> columns = columns_of(basis, mesh, function);
    const auto number = static_cast<std::size_t>(
        arguments.whole("--number", 1, 1, static_cast<std::int32_t>(columns.size())) - 1);
    OutputFiles files;
    if (arguments.has("--csv")) write_csv(files.add(arguments.text("--csv")), mesh, columns);
    if (arguments.has("--vtu")) {
        write_vtu(files.add(arguments.text("--vtu")), mesh, mesh.x, mesh.y, point_data(columns));
    }
    if (arguments.has("--svg")) {
        files.add(arguments.text("--svg"))
            << (has_window(arguments) ? function_picture(mesh, basis, function, columns[number], window_of(arguments))
                                      : function_picture(mesh, basis, function, columns[number]));
    }
    files.commit();
}

} // namespace

const Command export_command = {
    "export",
    {"MESH", "BASIS"},
    "Writes one function of a basis for other programs and as a picture",
    "Functions are numbered from 1 as their control points are. With --level: the cells that agglomeration merges instead,\n"
    "for a basis solved with --engine multigrid or fas.\n",
    {format_option,
     zone_option,
     {"--function", "I", "which function (required without --level)"},
     {"--csv", "FILE", "table with the columns point,x,y and value (real), value,imaginary (complex: conformal) or\n"
                       "xx,xy,yx,yy (matrix: with slip); points as numbered in the mesh file"},
     {"--vtu", "FILE", "mesh and function for ParaView, its numbers as components"},
     {"--svg", "FILE", "picture of one number: filled cells with a colour bar"},
     window_option,
     {"--number", "K", "which number the picture shows, in the order of the table (default 1)"},
     {"--level", "L", "picture of a level of agglomeration; 0: the mesh's own control volumes"},
     agglomeration_option},
    "  harmorph export naca0012.su2 airfoil.basis --function 7 --svg function.svg\n",
    run};

} // namespace cli
