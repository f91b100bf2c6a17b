// The C interface: copies structured blocks whose coordinates lie in separate arrays.
#include "views.hpp"

namespace harmorph {
namespace {

// Distances [doubles] from one point of a block to the next along i (step) and along j (row). The
// header says what row 0 means.
struct Distances {
    std::int64_t step, row;
};

// Tells whether an array can have these distances. No product overflows here, or later when points
// are visited. In an array that is written, no two points may have the same place.
bool is_of_points(Distances d, GridBlock const& block, bool written) noexcept {
    constexpr std::int64_t largest = std::int64_t{1} << 40, longest = std::int64_t{1} << 60;
    if (d.step < 1 || d.step > largest || d.row < 0 || d.row > largest) return false;
    if (d.row == 0 && d.step > largest / block.ni) return false;
    std::int64_t const row = d.row == 0 ? d.step * block.ni : d.row, ni = block.ni, nj = block.nj;
    if (d.step > longest / ni || row > longest / nj) return false;
    return !written || row > (ni - 1) * d.step || d.step > (nj - 1) * row;
}

// The blocks of one call, and the places of their points among those of the mesh.
struct BlocksOfMesh {
    Mesh mesh;
    Index first = 0, n = 0;

    Status open(const hm_mesh* given, std::int32_t from, std::int32_t count,
                CallFault& fault) noexcept {
        HARMORPH_TRY(view_mesh(given, mesh, fault));
        if (mesh.layout != CellLayout::blocks) {
            return fault.refuse(
                Status::bad_argument,
                "the mesh has no blocks, because mesh.cell_layout is not HM_CELLS_BLOCKS");
        }
        HARMORPH_TRY(check_layout(mesh, fault));
        first = from;
        n = count;
        if (first >= 0 && n >= 1 && n <= mesh.n_blocks && first <= mesh.n_blocks - n)
            return Status::ok;
        return fault.refuse(Status::bad_argument,
                            "first is # and n is @, but they must name at least one block, and "
                            "only blocks of the mesh",
                            block_item(first), plain(n));
    }

    // Calls visit(k, block) for the blocks of the call, k from 0, until visit returns true.
    template <class Visit>
    void each(Visit const& visit) const noexcept {
        Index b = 0;
        mesh.find_block([&](GridBlock const& block) {
            Index const k = b++ - first;
            return k >= n || (k >= 0 && visit(k, block));
        });
    }

    // Checks the arrays of all blocks; Given is the const or the other struct.
    template <class Given>
    Status check(const Given* blocks, bool written, Fault& fault) const noexcept {
        HARMORPH_TRY(require({{"blocks", blocks}}, fault));
        each([&](Index k, GridBlock const& block) {
            Given const& given = blocks[k];
            if (given.x == nullptr || given.y == nullptr) {
                fault.refuse(Status::bad_argument, "x or y of block # is NULL",
                             block_item(first + k));
                return true;
            }
            if (!is_of_points({stride_of(given.stride), given.row}, block, written)) {
                fault.refuse(Status::bad_argument,
                             "stride or row of block # is negative, beyond 2^40, or puts two "
                             "points at one place",
                             block_item(first + k));
                return true;
            }
            return false;
        });
        return fault.status;
    }

    // Calls move(arrays of the block, number in the arrays of the mesh, number in those of the
    // block) for each point.
    template <class Given, class Move>
    void each_point(const Given* blocks, Move const& move) const noexcept {
        each([&](Index k, GridBlock const& block) {
            std::int64_t const step = stride_of(blocks[k].stride);
            std::int64_t const row = blocks[k].row == 0 ? step * block.ni : blocks[k].row;
            Index point = block.first_point;
            for (Index j = 0; j < block.nj; ++j) {
                for (Index i = 0; i < block.ni; ++i) move(blocks[k], point++, i * step + j * row);
            }
            return false;
        });
    }
};

}  // namespace
}  // namespace harmorph

using namespace harmorph;

extern "C" {

hm_status hm_blocks_gather(const hm_mesh* mesh, int32_t first, int32_t n,
                           const hm_block_points* blocks, const hm_points_out* to, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        BlocksOfMesh asked;
        MutablePoints all;
        HARMORPH_TRY(asked.open(mesh, first, n, fault));
        HARMORPH_TRY(asked.check(blocks, false, fault));
        HARMORPH_TRY(view_points(to, "to", all, fault));
        asked.each_point(blocks, [&](hm_block_points const& given, Index point, std::int64_t at) {
            all.x[point * all.stride] = given.x[at];
            all.y[point * all.stride] = given.y[at];
        });
        return Status::ok;
    });
}

hm_status hm_blocks_scatter(const hm_mesh* mesh, int32_t first, int32_t n, const hm_points* from,
                            const hm_block_points_out* blocks, hm_error* err) {
    return guarded(err, [&](CallFault& fault) {
        BlocksOfMesh asked;
        Points all;
        HARMORPH_TRY(asked.open(mesh, first, n, fault));
        HARMORPH_TRY(asked.check(blocks, true, fault));
        HARMORPH_TRY(view_points(from, "from", all, fault));
        asked.each_point(blocks,
                         [&](hm_block_points_out const& given, Index point, std::int64_t at) {
                             given.x[at] = all.x[point * all.stride];
                             given.y[at] = all.y[point * all.stride];
                         });
        return Status::ok;
    });
}

}  // extern "C"
