"use strict";
// The triangles and quadrilaterals by which cells are drawn: painters fill nothing else.

// Cells are the rows cell_start, cell_points. Returns start [cells + 1] and points, four for each piece; a triangle
// repeats its last point. A polygon, or a quadrilateral that is not convex, is divided at the coordinates x, y.
function pieces_of({ cell_start, cell_points }, x, y) {
    const n_cells = cell_start.length - 1,
        start = new Int32Array(n_cells + 1),
        points = new Int32Array(4 * cell_points.length);
    let n = 0;
    const put = (a, b, c, d = c) => points.set([a, b, c, d], 4 * n++);
    for (let cell = 0; cell < n_cells; ++cell) {
        const corners = cell_points.subarray(cell_start[cell], cell_start[cell + 1]);
        if (corners.length === 3) put(...corners);
        else if (corners.length === 4 && is_convex(corners, x, y)) put(...corners);
        else cut_ears([...corners], x, y, put);
        start[cell + 1] = n;
    }
    return { start, points: points.slice(0, 4 * n) };
}

// Twice the area of a triangle, positive if the points a, b, c are counter-clockwise.
function twice_area(a, b, c, x, y) {
    return (x[b] - x[a]) * (y[c] - y[a]) - (x[c] - x[a]) * (y[b] - y[a]);
}

function is_convex([a, b, c, d], x, y) {
    const one = Math.sign(twice_area(a, b, c, x, y)) + Math.sign(twice_area(c, d, a, x, y)),
        other = Math.sign(twice_area(b, c, d, x, y)) + Math.sign(twice_area(d, a, b, x, y));
    return Math.abs(one + other) === 4;
}

// Cuts triangles off a polygon until one is left: always at the first corner that is convex and whose triangle contains
// no other corner; where there is none, as in a polygon that crosses itself, at the first corner.
function cut_ears(corners, x, y, put) {
    const first = corners[0],
        area = corners.reduce((sum, a, k) => sum + twice_area(first, a, corners[(k + 1) % corners.length], x, y), 0),
        sign = area < 0 ? -1 : 1;
    while (corners.length > 3) {
        const n = corners.length,
            ends = (k) => [corners[(k + n - 1) % n], corners[k], corners[(k + 1) % n]];
        const is_ear = (_, k) => {
            const [a, b, c] = ends(k);
            const contains = (p) =>
                sign * twice_area(a, b, p, x, y) >= 0 &&
                sign * twice_area(b, c, p, x, y) >= 0 &&
                sign * twice_area(c, a, p, x, y) >= 0;
            if (!(sign * twice_area(a, b, c, x, y) > 0)) return false;
            return !corners.some((p) => p !== a && p !== b && p !== c && contains(p));
        };
        const ear = Math.max(corners.findIndex(is_ear), 0);
        put(...ends(ear));
        corners.splice(ear, 1);
    }
    put(...corners);
}
