"use strict";
// Cells of any number of corners are divided into triangles and quadrilaterals, as harmorph.h describes at
// HM_CELLS_POLYGONS. The operations and their order are those of src/mesh/division.cpp, and so are the triangles.

const corner_kind = { convex: 0, flat: 1, reflex: 2 };

// start [cells + 1] is the first piece of each cell, and points [4*pieces] are the corners of the pieces; a triangle
// repeats its last point. For cells in several pieces, guard_start [cells + 1] is the first corner, guards [3*corners]
// has each corner between its neighbours, and kinds [corners] says what the corner was. All of them, and the rows of
// the cells, are counter-clockwise afterwards.
class Pieces {
    constructor(data) {
        const { cell_start, cell_points } = data,
            n = cell_start.length - 1;
        this.start = new Int32Array(n + 1);
        this.guard_start = new Int32Array(n + 1);
        const pieces = [],
            guards = [],
            kinds = [];
        for (let cell = 0; cell < n; ++cell) {
            const row = cell_points.subarray(cell_start[cell], cell_start[cell + 1]),
                corners = new CellOutline(row, data.x, data.y),
                first = pieces.length;
            if (row.length <= 4 && (!data.has_polygons || corners.are_convex())) {
                pieces.push([row[0], row[1], row[2], row[row.length - 1]]);
            } else {
                for (const [i, k, j] of corners.triangles()) pieces.push([row[i], row[k], row[j], row[j]]);
                row.forEach((point, k) => {
                    const before = row[corners.previous(k)],
                        after = row[corners.next(k)];
                    guards.push(...(corners.reversed ? [after, point, before] : [before, point, after]));
                    kinds.push(corners.kind(k));
                });
            }
            if (corners.reversed) {
                row.reverse();
                for (const piece of pieces.slice(first)) Pieces.reverse(piece);
            }
            this.start[cell + 1] = pieces.length;
            this.guard_start[cell + 1] = kinds.length;
        }
        this.points = new Int32Array(pieces.flat());
        this.guards = new Int32Array(guards);
        this.kinds = new Uint8Array(kinds);
    }

    static reverse(piece) {
        const [a, b, c, d] = piece;
        [piece[0], piece[1], piece[2], piece[3]] = c === d ? [c, b, a, a] : [d, c, b, a];
    }
}

class CellOutline {
    constructor(row, x, y) {
        Object.assign(this, { row, x, y, n: row.length, reversed: false });
        let sum = 0;
        for (let k = 1; k + 1 < this.n; ++k) {
            const [a, b, c] = [row[0], row[k], row[k + 1]];
            sum += (x[b] - x[a]) * (y[c] - y[a]) - (y[b] - y[a]) * (x[c] - x[a]);
        }
        this.reversed = sum < 0;
    }

    next(k) {
        return k + 1 === this.n ? 0 : k + 1;
    }
    previous(k) {
        return k === 0 ? this.n - 1 : k - 1;
    }

    kind(k) {
        const { row, x, y } = this,
            [a, b, c] = [row[this.previous(k)], row[k], row[this.next(k)]],
            ux = x[b] - x[a],
            uy = y[b] - y[a],
            vx = x[c] - x[b],
            vy = y[c] - y[b],
            turn = (ux * vy - uy * vx) * (this.reversed ? -1 : 1),
            ahead = ux * vx + uy * vy,
            tolerance = 0.125; // tangent of the exterior angle
        if (turn > 0 && turn > tolerance * ahead) return corner_kind.convex;
        return turn < 0 && -turn > tolerance * ahead ? corner_kind.reflex : corner_kind.flat;
    }

    are_convex() {
        return this.n === 3 || this.row.every((point, k) => this.kind(k) === corner_kind.convex);
    }

    shape(i, k, j) {
        const { row, x, y } = this,
            [a, b, c] = [row[i], row[k], row[j]],
            ux = x[b] - x[a],
            uy = y[b] - y[a],
            vx = x[c] - x[b],
            vy = y[c] - y[b],
            wx = x[a] - x[c],
            wy = y[a] - y[c],
            area = ux * vy - uy * vx,
            squares = ux * ux + uy * uy + (vx * vx + vy * vy) + (wx * wx + wy * wy);
        return squares > 0 ? (this.reversed ? -area : area) / squares : 0;
    }

    // Returns corners i, k, j of triangles whose worst one is as good as possible (G. T. Klincsek, Ann. Discrete Math.
    // 9 (1980) 121).
    triangles() {
        const { n } = this,
            worst = new Float64Array(n * n),
            apex = new Int32Array(n * n);
        for (let i = 0; i + 1 < n; ++i) worst[i * n + i + 1] = Infinity;
        for (let width = 2; width < n; ++width) {
            for (let i = 0; i + width < n; ++i) {
                const j = i + width;
                let best = -1,
                    best_worst = 0;
                for (let k = i + 1; k < j; ++k) {
                    const parts = Math.min(worst[i * n + k], worst[k * n + j]);
                    if (best >= 0 && !(parts > best_worst)) continue;
                    const all = Math.min(parts, this.shape(i, k, j));
                    if (best >= 0 && !(all > best_worst)) continue;
                    best = k;
                    best_worst = all;
                }
                worst[i * n + j] = best_worst;
                apex[i * n + j] = best;
            }
        }
        const found = [],
            sides = [[0, n - 1]];
        for (const [i, j] of sides) {
            if (j === i + 1) continue;
            const k = apex[i * n + j];
            found.push([i, k, j]);
            sides.push([i, k], [k, j]);
        }
        return found;
    }
}

// Calls visit(a, b) for each side of each cell, counter-clockwise.
function for_each_side({ cell_start, cell_points }, visit) {
    for (let cell = 0; cell + 1 < cell_start.length; ++cell)
        for_each_pair(cell_points.subarray(cell_start[cell], cell_start[cell + 1]), visit);
}
