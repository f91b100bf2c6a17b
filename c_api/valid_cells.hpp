// Refuses meshes with an inverted cell, for calls that look into the cells.
#pragma once

#include "base/executor.hpp"
#include "handles.hpp"
#include "mesh/cell_shape.hpp"

namespace harmorph {

// `text` is the sentence of the refusal, in which # is the number of the first inverted cell.
inline Status check_inverted(Topology const& topology, Points at, Executor const& threads,
                             const char* text, Fault& fault) noexcept {
    Index const bad = find_in_ranges(topology.mesh.n_cells, threads, [&](Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            if (is_inverted(CellShape(topology.cell(i), at, false))) return i;
        }
        return none;
    });
    if (bad == none) return Status::ok;
    return fault.refuse(Status::bad_mesh, text, cell_item(topology.mesh.number(bad)));
}

}  // namespace harmorph
