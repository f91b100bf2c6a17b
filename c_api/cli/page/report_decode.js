"use strict";
// The program writes `page_data`, one object, whose arrays are little-endian numbers in base 64.
//
//   version, mesh, basis      text
//   all_points, all_cells     numbers of points and cells of the whole mesh
//   points, in_cells, cells   numbers of points and cells of this page; the first in_cells points belong to whole cells
//   point [points]            the places of the points in the mesh, from 0
//   x, y [points]             coordinates before anything moves, in double precision
//   cell [cells]              the places of the cells in the mesh
//   cell_start [cells+1], cell_points    rows of points
//   has_polygons              true for a mesh of HM_CELLS_POLYGONS, where cells of four corners may be divided, too
//   face_points, face_markers the faces of the boundary
//   markers                   name and kind, and the curves or the body of a marker, and the marker across a sliding
//                             interface
//   thin_edges [2*]           the lines that are drawn beyond the cells
//   control, weights, curves  the B-spline before anything moves, see curve.js
//   bodies                    marker and centre of each rigid body
//   numbers                   numbers per value: 1 real, 2 complex, 4 a matrix xx, xy, yx, yy
//   functions                 values in single precision: [function][number][point]
//   moves                     the text of a file of movements to begin with, or ""

function decode_base64(text, Numbers) {
    const characters = atob(text);
    const bytes = new Uint8Array(characters.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
    return new Numbers(bytes.buffer);
}

function decode(raw) {
    const data = Object.assign({}, raw);
    for (const name of ["x", "y", "control", "weights"]) data[name] = decode_base64(raw[name], Float64Array);
    for (const name of ["point", "cell", "cell_start", "cell_points", "face_points", "face_markers", "thin_edges"]) {
        data[name] = decode_base64(raw[name], Int32Array);
    }
    data.functions = decode_base64(raw.functions, Float32Array);
    data.curves = raw.curves.map((curve) => ({
        degree: curve.degree,
        indices: decode_base64(curve.indices, Int32Array),
        knots: decode_base64(curve.knots, Float64Array),
    }));
    data.n_control = data.control.length / 2;
    data.n_functions = data.n_control + 2 * raw.bodies.length;
    data.pieces = new Pieces(data);
    return data;
}
