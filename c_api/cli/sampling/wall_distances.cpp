#include "sampling/wall_distances.hpp"

namespace cli {

WallDistances::WallDistances(const Mesh& mesh, const std::vector<std::int32_t>& markers,
                             const Threads& threads)
    : mesh_(mesh), threads_(threads), faces_(mesh.x.size(), -1), distances_(mesh.x.size()) {
    const MeshAnalysis analysis(mesh);
    const auto n = static_cast<std::int32_t>(markers.size());
    std::size_t bytes = 0;
    call(mesh, hm_walls_size, analysis.get(), n, markers.data(), &bytes);
    block_.resize(bytes);
    call(mesh, hm_walls_init, &walls_, block_.data(), bytes, analysis.get(), n, markers.data(),
         nullptr);
}

const std::vector<double>& WallDistances::values(const std::vector<double>& coordinates) {
    const hm_points at = {coordinates.data(), coordinates.data() + 1, 2};
    call(mesh_, hm_walls_move, walls_, &at);
    call(mesh_, hm_wall_distance, walls_, mesh_.points(), &at, faces_.data(), distances_.data(),
         faces_.data(), nullptr, threads_.executor());
    return distances_;
}

}  // namespace cli
