// Boundary conditions of a CGNS file become markers of the mesh of the plane. This source is
// compiled by `make CGNS=1` only.
#pragma once

#ifdef HARMORPH_CGNS
#include "formats/cgns_file.hpp"

#include <map>
#include <set>

namespace cli {

// The points of elements of the boundary, by zone and number.
using CgnsSides = std::map<std::pair<std::size_t, cgsize_t>, std::vector<std::int32_t>>;

class CgnsConditions {
public:
    // plane_point: for each point of the file, the point of the mesh with whose coordinates it
    // moves.
    CgnsConditions(Mesh& mesh, const Cgns& cgns, const std::vector<CgnsZone>& zones,
                   int cell_dimension, std::vector<std::int32_t> plane_point,
                   const CgnsSides& sides)
        : mesh_(mesh),
          cgns_(cgns),
          zones_(zones),
          cell_dimension_(cell_dimension),
          plane_point_(std::move(plane_point)),
          sides_(sides) {}

    void read();  // adds faces and markers to the mesh, which has its cells

private:
    using Edge = std::pair<std::int32_t, std::int32_t>;
    using Points = std::set<std::int32_t>;  // points of the mesh

    void find_open_edges();
    void add_conditions(std::size_t z);
    Points structured_points(const CgnsZone& zone, const std::vector<cgsize_t>& items,
                             std::size_t dimensions, bool is_range, GridLocation_t location,
                             std::size_t& in_file) const;
    std::int32_t point(const CgnsZone& zone, const char* condition, cgsize_t number) const;
    std::int32_t plane_point(std::int32_t point) const {
        return plane_point_[static_cast<std::size_t>(point)];
    }
    void mark(const std::string& name, Edge edge);
    void mark_points(const std::string& name, const Points& points,
                     std::size_t in_file);  // in_file: number of points of the condition
    void mark_element(const std::string& name, std::size_t z, cgsize_t number);

    Mesh& mesh_;
    const Cgns& cgns_;
    const std::vector<CgnsZone>& zones_;
    int cell_dimension_;
    std::vector<std::int32_t> plane_point_;
    const CgnsSides& sides_;
    std::set<Edge> open_;  // boundary edges without a marker
};

}  // namespace cli
#endif
