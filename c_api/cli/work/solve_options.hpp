// The options of a solution together with those for studies, as one value that can be copied.
#pragma once

#include "basics/library.hpp"

#include <harmorph_study.h>

namespace cli {

struct SolveOptions : hm_options, hm_study_options {
    SolveOptions() : hm_options(sized<hm_options>()), hm_study_options(sized<hm_study_options>()) {
        study = this;
    }
    SolveOptions(const SolveOptions& other) : hm_options(other), hm_study_options(other) {
        study = this;
    }
    SolveOptions& operator=(const SolveOptions&) = delete;
};

}  // namespace cli
