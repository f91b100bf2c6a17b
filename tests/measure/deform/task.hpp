// The task of the drivers of `make deform`: one marker on all curves, by the default operator.
#pragma once

#include "curves/curves.hpp"
#include "basics/library.hpp"
#include "commands/task.hpp"

#include <string>

namespace deform {

inline cli::Task task_on(const cli::Mesh& mesh, const std::string& marker,
                         const cli::Curves& curves) {
    cli::Task task;
    task.curves = curves;
    auto condition = cli::sized<hm_condition>();
    condition.marker = mesh.find_markers(marker)[0];
    condition.n_curves = static_cast<std::int32_t>(curves.curves.size());
    task.conditions = {condition};
    return task;
}

}  // namespace deform
