// harmorph transfer: interpolates functions from one mesh to a finer mesh of the same domain.
#include "basics/json.hpp"
#include "basics/numbers.hpp"
#include "basics/print.hpp"
#include "basics/progress.hpp"
#include "commands/commands.hpp"
#include "files/output_file.hpp"
#include "files/threads.hpp"
#include "work/basis_file.hpp"
#include "work/read_mesh.hpp"
#include "work/task.hpp"

#include <harmorph_bases.h>

#include <algorithm>

namespace cli {

namespace {

// Returns the number of the marker that has the same name in the fine mesh.
std::int32_t same_marker(const Arguments& arguments, const Mesh& mesh, std::int32_t marker,
                         const Mesh& fine) {
    const std::string& tag = mesh.markers.at(static_cast<std::size_t>(marker));
    const auto found = std::find(fine.markers.begin(), fine.markers.end(), tag);
    if (found == fine.markers.end()) {
        arguments.refuse(fine.file.path() + " has no marker " + in_quotes(tag) +
                         ", which has a condition in " + mesh.file.path());
    }
    return static_cast<std::int32_t>(found - fine.markers.begin());
}

// Returns the problem of the basis with the markers of the fine mesh. The parameters of points on
// curves are not copied: they are computed for the points of the fine mesh.
Task task_on(const Arguments& arguments, const Basis& basis, const Mesh& mesh, const Mesh& fine) {
    Task task = task_of(basis);
    task.known_points.clear();
    for (hm_condition& condition : task.conditions) {
        condition.marker = same_marker(arguments, mesh, condition.marker, fine);
        if (condition.kind == HM_PERIODIC_PAIR || condition.kind == HM_ROTATION_PAIR ||
            condition.kind == HM_INTERFACE) {
            condition.partner = same_marker(arguments, mesh, condition.partner, fine);
        }
    }
    return task;
}

// Analysis and basis of the fine mesh, and the transfer to that basis.
class Transfer {
public:
    Transfer(const Mesh& fine, const Basis& basis, const Task& task,
             const Threads& threads)  // all must outlive the transfer
        : fine_(fine), basis_(basis), view_(fine.view()), options_(task.options) {
        options_.executor = threads.executor();
        problem_.mesh = &view_;
        problem_.curves = basis.curves().n_curves > 0 ? &basis.curves() : nullptr;
        problem_.n_conditions = static_cast<std::int32_t>(task.conditions.size());
        problem_.conditions = task.conditions.data();
    }

    void run(const Mesh& mesh) {
        const Stopwatch watch;
        with_memory(analysis_block_, [&](hm_memory* memory) {
            return call(fine_, hm_analysis_init, &analysis_, memory, &problem_, &options_);
        });
        with_memory(basis_block_, [&](hm_memory* memory) {
            return call(fine_, hm_basis_init, &transferred_, memory, analysis_);
        });
        const hm_mesh view = mesh.view();
        analysis_seconds_ = watch.seconds();
        with_memory(block_, [&](hm_memory* memory) {
            return call(fine_, hm_transfer, transferred_, memory, analysis_, basis_.get(), &view,
                        &report_);
        });
        transfer_seconds_ = watch.seconds() - analysis_seconds_;
    }

    const hm_basis* transferred() const { return transferred_; }
    const hm_transfer_report& report() const { return report_; }
    double analysis_seconds() const { return analysis_seconds_; }
    double transfer_seconds() const { return transfer_seconds_; }

private:
    const Mesh& fine_;
    const Basis& basis_;
    hm_mesh view_;
    SolveOptions options_;
    hm_problem problem_ = sized<hm_problem>();
    Block analysis_block_, basis_block_, block_;
    hm_analysis* analysis_ = nullptr;
    hm_basis* transferred_ = nullptr;
    hm_transfer_report report_ = sized<hm_transfer_report>();
    double analysis_seconds_ = 0, transfer_seconds_ = 0;
};

void print_json(const Transfer& transfer, const Mesh& fine, const Basis& basis) {
    const hm_transfer_report& report = transfer.report();
    JsonObject object;
    object.add("points", fine.points())
        .add("cells", fine.cells())
        .add("functions", basis.info().functions);
    object.add("interpolated", report.points)
        .add("outside", report.outside)
        .add("max_distance", report.max_distance);
    object.add("boundary_error", report.boundary_error)
        .add("wall_correction", report.wall_correction);
    object.add("analysis_seconds", transfer.analysis_seconds())
        .add("transfer_seconds", transfer.transfer_seconds());
    print("%s\n", object.text().c_str());
}

void print_for_people(const Transfer& transfer, const Mesh& fine, const Basis& basis) {
    const hm_transfer_report& report = transfer.report();
    print("%s from %s to %s, %d of them interpolated\n",
          plural(basis.info().functions, "function").c_str(),
          plural(basis.info().points, "point").c_str(), plural(fine.points(), "point").c_str(),
          report.points);
    print("outside          %d", report.outside);
    if (report.outside > 0) {
        print(", by %s at most (point %d)", brief(report.max_distance).c_str(),
              report.max_distance_point);
    }
    print("\nboundary error   %s; %s before the boundary functions were restored\n",
          brief(report.boundary_error).c_str(), brief(report.wall_correction).c_str());
    print("seconds          %s analysis of the fine mesh, %s transfer\n",
          brief(transfer.analysis_seconds()).c_str(), brief(transfer.transfer_seconds()).c_str());
}

}  // namespace

void run_transfer(const Arguments& arguments) {
    const std::string path = arguments.text("-o");
    const Mesh mesh = read_mesh(arguments, 0);
    const Basis basis(arguments.operand(1), mesh);
    if (basis.mesh_has_moved()) {
        throw Failure(
            exit_unusable,
            mesh.file.path() + ": the mesh has moved since " + basis.path() +
                " was solved; transfer from the mesh before it moved, and morph FINE_MESH");
    }
    const Mesh fine = read_mesh(arguments, 2);
    const Threads threads(threads_of(arguments));
    const Task task = task_on(arguments, basis, mesh, fine);
    Transfer transfer(fine, basis, task, threads);
    transfer.run(mesh);
    const Stored stored(arguments, fine, transfer.transferred());
    OutputFiles files;
    write_basis(files.add(path), stored.basis(), fine);
    files.commit();
    if (arguments.has("--json")) {
        print_json(transfer, fine, basis);
    } else {
        print_for_people(transfer, fine, basis);
    }
}

}  // namespace cli
