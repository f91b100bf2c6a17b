// The mesh of one design: one linear step where that is good enough, or else a safe morph.
#pragma once

#include "basics/field.hpp"
#include "commands/solver.hpp"
#include "mesh/basis_file.hpp"
#include "sampling/design_space.hpp"

#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace cli {

// The memory of a design serves the next one again.
struct MorphedDesign {
    Design design;
    std::vector<double> coordinates;  // [points][2]
    std::vector<double> control;      // [control points][2] of the moved curves
    std::vector<double> measures;     // of the section, see SectionMeasures
    double admissible_step = 0, min_quality = 0, mean_quality = 0;
    const char* way = "";      // linear, substeps, untangled, improved; empty: there is no mesh
    std::string refusal;       // why the design is rejected
    bool needs_safe = false;   // one linear step is not good enough
    std::exception_ptr fault;  // an error that is not about the design
    Field moved{0}, displacement{0};  // of the mesh, by the linear step

    void begin() {  // a new design, which has no mesh yet
        design = {};
        measures.clear();
        admissible_step = min_quality = mean_quality = 0;
        way = "";
        refusal.clear();
        needs_safe = false;
        fault = nullptr;
    }
};

class DesignMorpher {
public:
    // min_quality: the smallest quality that a linear step may leave, and the aim of a safe morph,
    // in parts of the smallest quality of the mesh.
    // wants_step: also find the admissible step, which takes about a third of the time.
    DesignMorpher(const Mesh& mesh, const Basis& basis, const Threads& threads, double min_quality,
                  bool wants_step);
    DesignMorpher(const DesignMorpher&) = delete;

    // Any number of threads may call this at once, each with another result.
    void morph_linearly(MorphedDesign& result) const;
    void morph_safely(MorphedDesign& result);

private:
    void take(MorphedDesign& result, const Field& moved) const;
    void move_control(MorphedDesign& result, const std::vector<double>& moves) const;

    const Mesh& mesh_;
    const hm_mesh view_;
    const Basis& basis_;
    const Threads& threads_;
    double least_quality_ = 0, min_quality_;
    bool slips_ = false, wants_step_;
    hm_executor one_thread_;
    Task task_;
    std::unique_ptr<Solver> solver_;  // made for the first safe morph
    Block work_;
};

}  // namespace cli
