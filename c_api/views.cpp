#include "limits.hpp"

namespace harmorph {
namespace {

constexpr Limit<hm_mesh> mesh_limits[] = {
    {&hm_mesh::cell_layout, HM_CELLS_ROWS, HM_CELLS_POLYGONS,
     "mesh.cell_layout is #, but it must be one of HM_CELLS_ROWS to HM_CELLS_POLYGONS"},
    {&hm_mesh::reserved, 0, 0, "mesh.reserved must be 0, not #"},
};

constexpr Limit<hm_executor> executor_limits[] = {
    {&hm_executor::n_threads, 1, Executor::max_threads,
     "executor.n_threads must be between 1 and 256, not #"},
    {&hm_executor::kernel, HM_KERNEL_AUTO, HM_KERNEL_NEON,
     "executor.kernel is #, but it must be one of HM_KERNEL_AUTO to HM_KERNEL_NEON",
     Status::unsupported},
};

// Counts the cells of all blocks. Returns 0 if a size or the sum is out of range.
Index cells_of_blocks(hm_mesh const& mesh) noexcept {
    Offset n = 0;
    for (Index b = 0; mesh.block_sizes != nullptr && b < min(mesh.n_blocks, Mesh::max_blocks);
         ++b) {
        Offset const ni = mesh.block_sizes[2 * b], nj = mesh.block_sizes[2 * b + 1];
        if (ni < 2 || nj < 2) return 0;
        n += (ni - 1) * (nj - 1);
        if (n > Mesh::max_cells) return 0;
    }
    return static_cast<Index>(n);
}

}  // namespace

Status view_mesh(const hm_mesh* given, Mesh& mesh, CallFault& fault) noexcept {
    hm_mesh m;
    HARMORPH_TRY(open_struct(given, m, "mesh", "hm_mesh", fault));
    HARMORPH_TRY(check_limits(m, mesh_limits, fault));
    mesh = Mesh{};
    mesh.index_base = fault.bases.mesh = m.index_base;
    mesh.n_points = m.n_points;
    mesh.points = points_of(m.points);
    mesh.layout = static_cast<CellLayout>(m.cell_layout);
    mesh.n_cells = m.n_cells;
    bool const block = mesh.layout == CellLayout::structured && m.ni > 1 && m.nj > 1;
    if (block && m.n_cells == 0) {
        Offset const n = (Offset{m.ni} - 1) * (Offset{m.nj} - 1);
        mesh.n_cells = n <= Mesh::max_cells ? static_cast<Index>(n) : 0;
    }
    mesh.n_blocks = m.n_blocks;
    mesh.block_sizes = m.block_sizes;
    if (mesh.layout == CellLayout::blocks) mesh.block_markers = m.block_markers;
    if (mesh.layout == CellLayout::blocks && m.n_cells == 0) mesh.n_cells = cells_of_blocks(m);
    mesh.cell_start = m.cell_start;
    mesh.cell_points = m.cell_points;
    mesh.n_quads = m.n_quads;
    mesh.quad_points = m.quad_points;
    mesh.ni = m.ni;
    mesh.nj = m.nj;
    mesh.n_faces = m.n_faces;
    mesh.face_points = m.face_points;
    mesh.face_markers = m.face_markers;
    mesh.n_lists = m.n_lists;
    mesh.list_start = m.list_start;
    mesh.list_points = m.list_points;
    mesh.list_markers = m.list_markers;
    HARMORPH_TRY(check_counts(mesh, fault));
    HARMORPH_TRY(check_polygons(mesh, fault));
    fault.bases.set(mesh);
    return Status::ok;
}

Status view_executor(const hm_executor* given, Executor& executor, Fault& fault) noexcept {
    executor = Executor{};
    if (given == nullptr) return Status::ok;
    hm_executor e;
    HARMORPH_TRY(open_struct(given, e, "executor", "hm_executor", fault));
    if (e.n_threads == 0) e.n_threads = 1;
    HARMORPH_TRY(check_limits(e, executor_limits, fault));
    executor = {e.run, e.user, e.n_threads, static_cast<Kernel>(e.kernel)};
    return Status::ok;
}

}  // namespace harmorph
