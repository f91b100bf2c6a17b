"use strict";
// The program writes `page_module`, the library for WebAssembly (gzip, in base 64), and `page_data`, one object, whose
// arrays are little-endian numbers in base 64. Everything is counted from 0.
//
//   version, mesh             text
//   operator, operator_kind   the name of the operator, and its number in harmorph.h
//   exponent, offset_correction  as in hm_basis_info
//   x, y [points]             coordinates before anything moves
//   cell_start [cells+1], cell_points    rows of points
//   has_polygons              true for a mesh of HM_CELLS_POLYGONS
//   face_points, face_markers the faces of the boundary
//   markers                   the name of each marker
//   curves                    [{control, weights, curves: [{degree, indices, knots}]}]
//   conditions                as hm_condition; `along` is a place in
//   along                     curves along which points slip, each as in `curves`
//   basis_file                the bytes of the basis, or "": the page solves the functions
//   moves                     the text of a file of movements to begin with, or ""

function decode_curves(raw) {
    return {
        control: decode_base64(raw.control, Float64Array),
        weights: raw.weights === "" ? null : decode_base64(raw.weights, Float64Array),
        curves: raw.curves.map(({ degree, indices, knots }) => ({
            degree,
            indices: decode_base64(indices, Int32Array),
            knots: decode_base64(knots, Float64Array),
        })),
    };
}

function decode(raw) {
    const data = Object.assign({}, raw);
    for (const name of ["x", "y"]) data[name] = decode_base64(raw[name], Float64Array);
    for (const name of ["cell_start", "cell_points", "face_points", "face_markers"])
        data[name] = decode_base64(raw[name], Int32Array);
    Object.assign(data, decode_curves(raw.curves[0]), { along: raw.along.map(decode_curves) });
    data.n_control = data.control.length / 2;
    data.bodies = []; // marker and centre of each
    for (const { kind, body, marker, x, y } of raw.conditions) {
        if (kind === "rigid" && !data.bodies[body])
            data.bodies[body] = { marker: raw.markers[marker].name, x, y };
    }
    return data;
}

// Returns the condition of a marker, without its pieces; a marker without a condition is fixed.
function condition_of(data, marker) {
    const known = data.conditions.find((one) => one.marker === marker && one.kind !== "interface");
    return known || { kind: "fixed", marker };
}
