// Translates a fault of the core into the caller's hm_error: the numbers of items count from the
// caller's index bases, and the text is one sentence.
#pragma once

#include "harmorph.h"
#include "base/types.hpp"
#include "mesh/mesh.hpp"

namespace harmorph {

// The index bases of the caller. `mesh` holds for all items except curves, control points and
// knots, for which `curves` holds. Where only one of the two is known, it holds for all items.
// The sentences name points of structured blocks by i and j, too.
struct Bases {
    Index mesh = none;
    Index curves = none;
    Index ni = 0, n_blocks = 0;          // 0: the mesh has no blocks
    const Index* block_sizes = nullptr;  // [2 * n_blocks] ni and nj

    void set(Mesh const& view) noexcept {
        mesh = view.index_base;
        ni = view.layout == CellLayout::structured ? view.ni : 0;
        n_blocks = view.layout == CellLayout::blocks ? view.n_blocks : 0;
        block_sizes = view.block_sizes;
    }
};

// Fills *err, which may be null, and returns the status. A fault with Status::ok clears the error.
hm_status tell(hm_error* err, Fault const& fault, Bases bases = {}) noexcept;

}  // namespace harmorph
