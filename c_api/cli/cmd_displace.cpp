// harmorph displace: moves the points of a wall as a file says, and the mesh with them; no curves are needed.
#include "commands.hpp"
#include "engine.hpp"
#include "formats/format.hpp"
#include "json.hpp"
#include "morph.hpp"
#include "numbers.hpp"
#include "output_file.hpp"
#include "solver.hpp"
#include "task.hpp"
#include "vtu.hpp"
#include "wall_field.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cli {

namespace {

struct Displacement {
    Field by, moved;
    hm_step_report step = sized<hm_step_report>();
    hm_quality_report quality = sized<hm_quality_report>();
    double factor_seconds = 0, displace_seconds = 0; // the latter: the median

    explicit Displacement(const Mesh& mesh) : by(mesh.x.size()), moved(mesh.x.size()) {}
    bool valid() const { return quality.inverted == 0 && quality.self_crossing == 0; }
};

void displace(Solver& solver, const std::string& path, const WallField& wall, const hm_points* from, Field& to, Block& work) {
    const hm_points given = wall.read();
    const hm_points_out result = to.write();
    call(path, hm_displace, solver.plan(), wall.count(), wall.points.data(), 1, &given, from, &result, work.data(),
         work.size(), nullptr);
}

Displacement displacement_of(const Mesh& mesh, Solver& solver, const std::string& path, const WallField& wall,
                             std::int32_t repeats, const Threads& threads) {
    Displacement found(mesh);
    const Stopwatch whole;
    solver.prepare();
    call(mesh, hm_plan_factor, solver.plan(), nullptr);
    found.factor_seconds = whole.seconds();
    std::size_t bytes = 0;
    call(mesh, hm_displace_size, solver.plan(), 1, &bytes);
    Block work(bytes);
    const hm_points start = mesh.coordinates();
    displace(solver, path, wall, &start, found.moved, work); // refuses a wall that crosses itself
    std::vector<double> seconds;
    for (std::int32_t i = 0; i < repeats; ++i) {
        const Stopwatch watch;
        displace(solver, path, wall, nullptr, found.by, work);
        seconds.push_back(watch.seconds());
    }
    found.displace_seconds = median(seconds);
    round_as_file(mesh, found.moved.x, found.moved.y); // what is judged is what can be written
    const hm_mesh view = mesh.view();
    const hm_points along = found.by.read(), at = found.moved.read();
    call(mesh, hm_admissible_step, solver.basis(), &view, nullptr, &along, threads.executor(), &found.step);
    call(mesh, hm_quality, solver.basis(), &view, &at, &start, threads.executor(), &found.quality);
    return found;
}

void write_files(const Arguments& arguments, const Mesh& mesh, const Displacement& found) {
    OutputFiles files;
    if (arguments.has("-o")) write_moved(files.add(arguments.text("-o")), mesh, found.moved.x.data(), found.moved.y.data());
    if (arguments.has("--vtu")) {
        PointData data = {"displacement", 3, {}};
        for (std::size_t point = 0; point < found.by.x.size(); ++point) {
            data.values.insert(data.values.end(), {found.by.x[point], found.by.y[point], 0.0});
        }
        write_vtu(files.add(arguments.text("--vtu")), mesh, found.moved.x, found.moved.y, data);
    }
    files.commit();
}

void print_json(const Displacement& found) {
    JsonObject object;
    object.add("inverted", found.quality.inverted).add("admissible_step", found.step.admissible);
    object.add("self_crossing", found.quality.self_crossing != 0);
    object.add("min_quality", found.quality.min_quality).add("mean_quality", found.quality.mean_quality);
    object.add("factor_seconds", found.factor_seconds).add("displace_seconds", found.displace_seconds);
    std::printf("%s\n", object.text().c_str());
}

void print_for_people(const Displacement& found) {
    std::printf("inverted cells   %d\n", found.quality.inverted);
    std::printf("admissible step  %s\n",
                std::isinf(found.step.admissible) ? "unlimited" : (brief(found.step.admissible) + " of this one").c_str());
    std::printf("quality          %s at least, %s on average (size and skew, relative to the mesh as it was)\n",
                brief(found.quality.min_quality).c_str(), brief(found.quality.mean_quality).c_str());
    std::printf("seconds          %s for analysis and factor, %s for the displacement\n", brief(found.factor_seconds).c_str(),
                brief(found.displace_seconds).c_str());
}

std::string reason(const Displacement& found, const Mesh& mesh) {
    std::string text = plural(found.quality.inverted, "inverted cell");
    if (found.step.cell >= 0) {
        const std::size_t line = mesh.cell_offset[static_cast<std::size_t>(found.step.cell)];
        text += ": " + brief(found.step.admissible) + " of this displacement is admissible, limited by cell " +
                std::to_string(found.step.cell) + " (" + mesh.file.place(line) + ")";
    }
    return found.quality.inverted > 0 ? text : "the boundary crosses itself once it is rounded to the file's digits";
}

void run(const Arguments& arguments) {
    const std::string path = arguments.text("--wall");
    const std::int32_t repeats = arguments.whole("--repeat", 1, 1, 1000000);
    if (!arguments.has("--given")) arguments.refuse("--given is missing");
    const Mesh mesh = read_mesh(arguments, 0);
    const WallField wall = read_wall_field(path, mesh);
    const Task task = task_of(arguments, mesh);
    const Threads threads(threads_of(arguments));
    Solver solver(mesh, task, threads);
    const Displacement found = displacement_of(mesh, solver, path, wall, repeats, threads);
    if (found.valid() || arguments.has("--force")) write_files(arguments, mesh, found);
    if (arguments.has("--json")) {
        print_json(found);
    } else {
        print_for_people(found);
    }
    if (!found.valid()) throw Failure(exit_unusable, reason(found, mesh));
}

// Of the options of `solve`, those that need no curve.
std::vector<Option> conditions_and_operator() {
    std::vector<Option> options = task_options();
    const auto needs_curve = [](const Option& option) {
        const std::string name = option.name;
        return name == "--curve" || name == "--rigid" || name == "--offset-correction";
    };
    options.erase(std::remove_if(options.begin(), options.end(), needs_curve), options.end());
    return options;
}

} // namespace

const Command displace_command = {
    "displace",
    {"MESH"},
    "Moves the points of a wall as a file says, and the mesh with them",
    "FIELD is a text file with lines \"point dx dy\": all points of the markers of --given, each with its displacement. Points\n"
    "are counted from 0 in the order of the mesh file, as SU2 files count them; `#` starts a comment. They move by exactly\n"
    "these displacements; the other points follow as they follow a curve in `harmorph morph`. Markers that are not named are\n"
    "fixed. A mesh with inverted cells is not written, and a wall that would cross itself is refused.\n",
    std::vector<Option>{
     {"--given", "A[,B..]", "markers whose displacements FIELD has (required; may be repeated)"},
     {"--wall", "FIELD", "their displacements (required)"},
     {"-o", "MESH", "moved mesh to write"},
     {"--vtu", "FILE", "moved mesh and its displacement for ParaView"}} +
    conditions_and_operator() + engine_options() +
    std::vector<Option>{
     {"--repeat", "N", "displace N times, in memory, and report the median time (default 1)"},
     threads_option,
     {"--force", nullptr, "write the files even if cells are inverted (exit code 1 all the same)"},
     format_option,
     zone_option,
     {"--json", nullptr, "print one JSON object: inverted, admissible_step (null: unlimited), self_crossing, min_quality,\n"
                         "mean_quality, factor_seconds (analysis included), displace_seconds"}},
    "  harmorph displace mesh.su2 --given airfoil --wall field.txt -o moved.su2\n",
    run};

} // namespace cli
