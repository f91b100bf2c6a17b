// Fields at the points of a mesh in the files of VTK (.vtk, .vtu) and OpenFOAM (pointVectorField),
// as tables: the columns x, y, z of the coordinates (VTK), NAME of an array of one number, and
// NAME_x, NAME_y, NAME_z of vectors. The vectors of OpenFOAM have the name Sensitivity.
#pragma once

#include "formats/point_table.hpp"

namespace cli {

bool is_point_fields(const TextFile& file);
PointTable read_point_fields(const std::shared_ptr<const TextFile>& file);

}  // namespace cli
