"use strict";
// A cell that is divided into triangles (see report_polygons.js) is valid while its triangles, and its corners with the
// angle that each corner may bend, have positive areas. harmorph.h gives the formulas at HM_CELLS_POLYGONS.

class DividedCell {
    constructor(pieces, model) {
        Object.assign(this, { pieces, model });
        const root = Math.SQRT1_2;
        this.turns = [[1, 0], [root, root], [-root, root]]; // 0, 45, 135 degrees for convex, flat, reflex corners
        this.length_product = 0;
    }

    // Sets smallest (twice the area of the worst corner), area and quality.
    judge(cell) {
        const { start, points, guard_start, guards, kinds } = this.pieces;
        this.smallest = Infinity;
        this.area = 0;
        let convex = 0,
            sum = 0;
        for (let k = 4 * start[cell]; k < 4 * start[cell + 1]; k += 4) {
            const twice_area = this.triangle(points[k], points[k + 1], points[k + 2], this.turns[0]);
            this.smallest = Math.min(this.smallest, twice_area);
            this.area += 0.5 * twice_area;
        }
        for (let guard = guard_start[cell]; guard < guard_start[cell + 1]; ++guard) {
            const k = 3 * guard,
                is_convex = kinds[guard] === corner_kind.convex,
                twice_area = this.triangle(guards[k], guards[k + 1], guards[k + 2], this.turns[kinds[guard]]);
            if (is_convex || !(twice_area > 0)) this.smallest = Math.min(this.smallest, twice_area);
            if (!is_convex) continue;
            sum += this.length_product / twice_area;
            ++convex;
        }
        this.quality = convex < 3 ? 1 : Math.min(1, convex / (sum * Math.sin((2 * Math.PI) / convex)));
    }

    // Returns twice the area between the side from a to b, turned back, and the side from b to c.
    triangle(a, b, c, [cosine, sine]) {
        const { x, y } = this.model,
            [ux, uy] = [x[b] - x[a], y[b] - y[a]],
            [px, py] = [cosine * ux + sine * uy, cosine * uy - sine * ux],
            [qx, qy] = [x[c] - x[b], y[c] - y[b]];
        this.length_product = Math.hypot(px, py) * Math.hypot(qx, qy);
        return px * qy - py * qx;
    }
}
