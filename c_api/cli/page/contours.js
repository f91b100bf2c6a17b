"use strict";
// Contour lines of values at the mesh points, found in the triangles of which the pieces of cells consist.

class Contours {
    constructor() {
        this.positions = new Float32Array(4096);
        this.n = 0; // number of segments
        this.values = null; // to which parts belong
    }

    // Finds the contours at the multiples of `distance` on a canvas; screen holds the pixels of the points, in pairs.
    find(points, screen, values, distance, width, height) {
        this.n = 0;
        this.number_parts(values, distance);
        const { parts } = this;
        for (let i = 0; i < points.length; i += 4) {
            const a = points[i],
                b = points[i + 1],
                c = points[i + 2],
                d = points[i + 3];
            if (parts[a] === parts[b] && parts[b] === parts[c] && parts[c] === parts[d]) continue;
            const left = Math.min(screen[2 * a], screen[2 * b], screen[2 * c], screen[2 * d]),
                right = Math.max(screen[2 * a], screen[2 * b], screen[2 * c], screen[2 * d]);
            if (right < 0 || left > width) continue;
            const top = Math.min(screen[2 * a + 1], screen[2 * b + 1], screen[2 * c + 1], screen[2 * d + 1]),
                bottom = Math.max(screen[2 * a + 1], screen[2 * b + 1], screen[2 * c + 1], screen[2 * d + 1]);
            if (bottom < 0 || top > height) continue;
            this.triangle(a, b, c, screen, values, distance);
            if (d !== c) this.triangle(a, c, d, screen, values, distance);
        }
    }

    // Numbers the parts between neighbouring levels, in which the values lie: a line passes between two parts.
    number_parts(values, distance) {
        if (this.values === values) return;
        this.values = values;
        this.parts = new Int32Array(values.length);
        for (let k = 0; k < values.length; ++k) this.parts[k] = Math.floor(values[k] / distance);
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
