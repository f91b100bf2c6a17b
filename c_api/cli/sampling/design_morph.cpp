#include "sampling/design_morph.hpp"

#include "basics/numbers.hpp"
#include "formats/format.hpp"
#include "work/safe_way.hpp"

#include <algorithm>

namespace cli {

DesignMorpher::DesignMorpher(const Mesh& mesh, const Basis& basis, const Threads& threads,
                             double min_quality, bool wants_step)
    : mesh_(mesh),
      view_(mesh.view()),
      basis_(basis),
      threads_(threads),
      min_quality_(min_quality),
      wants_step_(wants_step),
      one_thread_(*threads.executor()),
      task_(task_of(basis)) {
    one_thread_.run = nullptr;
    one_thread_.n_threads = 1;

    auto quality = sized<hm_quality_report>();
    call(mesh, hm_assess, basis.get(), &view_, nullptr, nullptr, nullptr, threads.executor(),
         nullptr, &quality);
    lowest_quality_ = min_quality * quality.min_quality;
}

void DesignMorpher::move_control(MorphedDesign& result, const std::vector<double>& moves) const {
    const hm_curves& before = basis_.curves();
    result.control.assign(before.control, before.control + 2 * before.n_control);
    for (std::size_t k = 0; k < result.control.size(); ++k) result.control[k] += moves[k];
}

void DesignMorpher::take(MorphedDesign& result, const Field& moved) const {
    result.coordinates.resize(2 * moved.x.size());
    for (std::size_t k = 0; k < moved.x.size(); ++k) {
        result.coordinates[2 * k] = moved.x[k];
        result.coordinates[2 * k + 1] = moved.y[k];
    }
}

void DesignMorpher::morph_linearly(MorphedDesign& result) const {
    const std::size_t n = mesh_.x.size();
    Field &moved = result.moved, &displacement = result.displacement;
    for (std::vector<double>* const numbers :
         {&moved.x, &moved.y, &displacement.x, &displacement.y})
        numbers->resize(n);
    const std::vector<double>& moves = result.design.moves;
    const hm_points from = mesh_.coordinates();
    const hm_points_out to = moved.write();
    call(basis_.path(), hm_morph, basis_.get(), moves.data(), &from, &to, &one_thread_);
    for (std::size_t k = 0; k < n; ++k) {
        displacement.x[k] = moved.x[k] - mesh_.x[k];
        displacement.y[k] = moved.y[k] - mesh_.y[k];
    }
    auto step = sized<hm_step_report>();
    auto quality = sized<hm_quality_report>();
    const hm_points along = displacement.read();
    call(mesh_, hm_assess, basis_.get(), &view_, nullptr, &along, nullptr, &one_thread_,
         wants_step_ ? &step : nullptr, &quality);
    move_control(result, moves);
    result.admissible_step = std::min(step.admissible, step.boundary);
    result.min_quality = quality.min_quality;
    result.mean_quality = quality.mean_quality;
    result.needs_safe = task_.slips() || quality.inverted > 0 || quality.self_crossing > 0 ||
                        quality.min_quality < lowest_quality_;
    if (result.needs_safe) return;
    round_as_file(mesh_, moved.x, moved.y);
    take(result, moved);
    result.way = "linear";
}

void DesignMorpher::morph_safely(MorphedDesign& result) {
    auto target = sized<hm_safe_target>();
    target.move = result.design.moves.data();
    if (!solver_) {
        solver_ = std::make_unique<Solver>(mesh_, task_, threads_);
        solver_->prepare();
    }
    Field moved(mesh_.x.size());
    const hm_points_out to = moved.write();
    std::vector<double> reached(result.design.moves.size());
    auto options = sized<hm_safe_options>();
    options.reached = reached.data();
    options.min_quality = min_quality_ > 0 ? min_quality_ : -1;
    auto report = sized<hm_safe_report>();
    hm_error error = {};
    const hm_status status = with_memory(work_, [&](hm_memory* memory) {
        return hm_move_safe(solver_->plan(), basis_.get(), &target, &to, memory, &options, &report,
                            &error);
    });
    if (status < 0 && status != HM_CROSSING) refuse(error, mesh_);
    result.needs_safe = false;
    if (status != HM_CROSSING) {
        result.min_quality = report.min_quality;
        result.mean_quality = report.mean_quality;
    }
    if (status == HM_SHORT)
        result.refusal =
            "the mesh follows " + brief(100 * report.step_fraction) + " % of the movement";
    else if (status != HM_OK) result.refusal = error.text;
    if (!result.refusal.empty()) return;
    round_as_file(mesh_, moved.x, moved.y);
    move_control(result, reached);
    take(result, moved);
    result.way = strategy_name(report.strategy);
}

}  // namespace cli
