// The designs of `harmorph sample`: the options of the command select the parameters of the designs
// and the source of their values.
#pragma once

#include "curves/section.hpp"
#include "curves/variables_file.hpp"
#include "options/arguments.hpp"
#include "sampling/design_values.hpp"
#include "work/basis_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct Design {
    std::vector<double> values;  // of the parameters
    std::vector<double> moves;   // as hm_morph takes them
    double fit_error = -1;       // [length] largest distance from the section's points; -1: no fit
    std::string section;         // the file of the section, if there is one
    std::vector<std::string> warnings;  // about the section
};

class DesignSpace {
public:
    DesignSpace(const Arguments& arguments, const Basis& basis);
    DesignSpace(const DesignSpace&) = delete;

    std::int64_t count() const { return count_; }
    const std::vector<DesignParameter>& parameters() const { return values_.parameters(); }
    bool has_sections() const { return kind_ == Kind::naca || kind_ == Kind::cst || has_files(); }
    bool has_files() const { return kind_ == Kind::files; }
    // The file of the design; has_files() must be true.
    const std::string& file(std::int64_t number) const {
        return files_[static_cast<std::size_t>(number)];
    }
    const std::string& description() const { return description_; }  // one sentence

    // Throws a Failure if the design has no movement: a section that cannot be read or fitted. Any
    // number of threads may call this at once. Designs are counted from 0.
    Design design(std::int64_t number) const;

private:
    enum class Kind { variables, control, naca, cst, files };

    void choose_kind(const Arguments& arguments);
    std::vector<DesignParameter> parameters_of(const Arguments& arguments) const;
    void read_list(const std::string& path);
    Section section_of(const std::vector<double>& values) const;

    const Basis& basis_;
    Kind kind_ = Kind::control;
    VariableMap map_;
    std::string map_path_;
    std::int32_t curve_ = 0, n_upper_ = 0, n_lower_ = 0;
    bool on_chord_ = false;
    std::vector<std::string> files_;
    DesignValues values_;
    std::int64_t count_ = 0;
    std::string description_;
};

}  // namespace cli
