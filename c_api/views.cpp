#include "views.hpp"

namespace harmorph {
namespace {

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
    HARMORPH_TRY(require({{"mesh", given}}, fault));
    hm_mesh m;
    if (!read_struct(given, m))
        return fault.refuse(
            Status::bad_argument,
            "mesh.struct_size is not the size of an hm_mesh; begin with HM_INIT(mesh)");
    if (m.cell_layout < HM_CELLS_ROWS || m.cell_layout > HM_CELLS_POLYGONS) {
        return fault.refuse(
            Status::bad_argument,
            "mesh.cell_layout is #, but it must be one of HM_CELLS_ROWS to HM_CELLS_POLYGONS",
            plain(m.cell_layout));
    }
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
    if (!read_struct(given, e))
        return fault.refuse(
            Status::bad_argument,
            "executor.struct_size is not the size of an hm_executor; begin with HM_INIT(executor)");
    if (e.n_threads == 0) e.n_threads = 1;
    if (e.n_threads < 1 || e.n_threads > Executor::max_threads) {
        return fault.refuse(Status::bad_argument,
                            "executor.n_threads must be between 1 and 256, not #",
                            plain(e.n_threads));
    }
    if (e.kernel < HM_KERNEL_AUTO || e.kernel > HM_KERNEL_NEON) {
        return fault.refuse(
            Status::unsupported,
            "executor.kernel is #, but it must be one of HM_KERNEL_AUTO to HM_KERNEL_NEON",
            plain(e.kernel));
    }
    executor = {e.run, e.user, e.n_threads, static_cast<Kernel>(e.kernel)};
    return Status::ok;
}

}  // namespace harmorph
