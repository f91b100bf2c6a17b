"use strict";
// Contour lines of values at the mesh points, found in the triangles of which the pieces of cells consist.

class Contours {
    constructor() {
        this.positions = new Float32Array(4096);
        this.n = 0; // number of segments
    }

    // Finds the contours at the multiples of `distance` on a canvas; screen holds the pixels of the points, in pairs.
    find(points, screen, values, distance, width, height) {
        this.n = 0;
        const part = (k) => Math.floor(values[k] / distance), // a line passes between points of different parts
            parts = Int32Array.from(values, (_, k) => part(k));
        for (let i = 0; i < points.length; i += 4) {
            const a = points[i],
                b = points[i + 1],
                c = points[i + 2],
                d = points[i + 3];
            if (parts[a] === parts[b] && parts[b] === parts[c] && parts[c] === parts[d]) continue;
            const outside = (axis, size) => {
                const [p, q, r, t] = [a, b, c, d].map((k) => screen[2 * k + axis]);
                return Math.max(p, q, r, t) < 0 || Math.min(p, q, r, t) > size;
            };
            if (outside(0, width) || outside(1, height)) continue;
            this.triangle(a, b, c, screen, values, distance);
            if (d !== c) this.triangle(a, c, d, screen, values, distance);
        }
    }

    triangle(a, b, c, screen, values, distance) {
        const va = values[a] / distance,
            vb = values[b] / distance,
            vc = values[c] / distance;
        const first = Math.ceil(Math.min(va, vb, vc)),
            last = Math.floor(Math.max(va, vb, vc));
        for (let level = first; level <= last; ++level) {
            let at = 4 * this.n,
                found = 0;
            if (at + 4 > this.positions.length) this.grow();
            const cross = (p, q, vp, vq) => {
                if (vp < level === vq < level || found === 2) return;
                const t = (level - vp) / (vq - vp);
                this.positions[at++] = screen[2 * p] + t * (screen[2 * q] - screen[2 * p]);
                this.positions[at++] = screen[2 * p + 1] + t * (screen[2 * q + 1] - screen[2 * p + 1]);
                ++found;
            };
            cross(a, b, va, vb);
            cross(b, c, vb, vc);
            cross(c, a, vc, va);
            if (found === 2) ++this.n;
        }
    }

    grow() {
        const grown = new Float32Array(2 * this.positions.length);
        grown.set(this.positions);
        this.positions = grown;
    }
}
