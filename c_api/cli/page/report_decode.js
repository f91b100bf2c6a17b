"use strict";
// The program writes `page_data`, one object, whose arrays are little-endian numbers in base 64.
//
//   version, mesh             text
//   all_cells, cells          numbers of cells of the whole mesh and of this page
//   x, y [points]             coordinates before anything moves
//   cell [cells]              the places of the cells in the mesh
//   cell_start [cells+1], cell_points    rows of points
//   has_polygons              true for a mesh of HM_CELLS_POLYGONS, where cells of four corners may be divided, too
//   face_points, face_markers the faces of the boundary
//   markers                   name and kind
//   thin_edges [2*]           the lines that are drawn beyond the cells
//   n_control                 number of control points
//   bodies                    the marker of each rigid body

function decode(raw) {
    const data = Object.assign({}, raw);
    for (const name of ["x", "y"]) data[name] = decode_base64(raw[name], Float64Array);
    for (const name of ["cell", "cell_start", "cell_points", "face_points", "face_markers", "thin_edges"])
        data[name] = decode_base64(raw[name], Int32Array);
    data.pieces = new Pieces(data);
    return data;
}
