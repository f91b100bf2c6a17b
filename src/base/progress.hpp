// Calls the caller's progress callback, which is told how far the work is and may stop it.
#pragma once

#include "base/types.hpp"

namespace harmorph {

enum class Phase : std::int32_t {
    structure = 0,
    ordering = 1,
    symbolic = 2,
    assembly = 3,
    factor = 4,
    solve = 5,
    residual = 6
};

struct Progress {
    std::int32_t (*call)(void* user, std::int32_t phase, double fraction) = nullptr;
    void* user = nullptr;

    Status report(Phase phase, Real fraction, Fault& fault) const noexcept {
        if (call == nullptr || call(user, static_cast<std::int32_t>(phase), fraction) == 0)
            return Status::ok;
        return fault.refuse(Status::cancelled, "the progress callback stopped the call");
    }
};

}  // namespace harmorph
