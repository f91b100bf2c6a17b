// The mesh of one design: one linear step where that is good enough, or else a safe morph.
#pragma once

#include "basics/geometry.hpp"
#include "sampling/design_space.hpp"
#include "work/basis_file.hpp"
#include "work/solver.hpp"

#include <exception>
#include <memory>
#include <string>
#include <vector>

namespace cli {

// A design and its mesh. The object can be used again for the next design, with the same memory.
struct MorphedDesign {
    Design design;
    std::vector<double> coordinates;  // [points][2]
    std::vector<double> control;      // [control points][2] of the moved curves
    std::vector<double> measures;     // of the section, see SectionMeasures
    double admissible_step = 0, min_quality = 0, mean_quality = 0;
    const char* way = "";      // linear, other, substeps, untangled, improved; empty: no mesh
    std::string refusal;       // why the design is rejected
    bool needs_safe = false;   // one linear step is not good enough
    std::exception_ptr fault;  // an error that is not about the design
    Field moved{0}, displacement{0};  // the mesh after the linear step, and the step

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
    // min_quality: the smallest quality that a linear step and a safe morph must leave, relative to
    // the smallest quality of the mesh.
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
    double lowest_quality_ = 0, min_quality_;
    bool wants_step_;
    hm_executor one_thread_;
    Task task_;
    std::unique_ptr<Solver> solver_;  // made for the first safe morph
    Block work_;
};

}  // namespace cli
