"use strict";
// The morph itself is X = X0 + sum_i F_i dP_i. Functions are in single precision, products and sums in double
// precision; therefore a point is within 2^-24 sum_i |F_i| |dP_i| of the place that `harmorph morph` computes, apart
// from the rounding of sums.

class Model {
    constructor(data) {
        this.n = data.x.length;
        this.x0 = data.x;
        this.y0 = data.y;
        this.numbers = data.numbers;
        this.n_functions = data.n_functions;
        this.functions = data.functions;
        this.dx = new Float64Array(this.n);
        this.dy = new Float64Array(this.n);
        this.x = data.x.slice();
        this.y = data.y.slice();
    }

    // moves [2*functions] is the array that hm_morph takes. The mesh always moves from the start, so that rounding
    // errors do not accumulate.
    morph(moves) {
        this.dx.fill(0);
        this.dy.fill(0);
        for (let i = 0; i < this.n_functions; ++i) {
            if (moves[2 * i] !== 0 || moves[2 * i + 1] !== 0) this.add_function(i, moves[2 * i], moves[2 * i + 1]);
        }
        for (let k = 0; k < this.n; ++k) {
            this.x[k] = this.x0[k] + this.dx[k];
            this.y[k] = this.y0[k] + this.dy[k];
        }
    }

    // Returns the values of one number of a function at all points.
    values(i, number) {
        const begin = (i * this.numbers + number) * this.n;
        return this.functions.subarray(begin, begin + this.n);
    }

    // Returns |F| at all points: the length of the first column of F, by which a movement of (1, 0) displaces a point.
    size_of_function(i) {
        const a = this.values(i, 0);
        if (this.numbers === 1) return a;
        const b = this.values(i, this.numbers === 2 ? 1 : 2);
        return a.map((value, k) => Math.hypot(value, b[k]));
    }

    // Returns the displacement of point k by the movement (mx, my) of function i.
    displacement(i, k, mx, my) {
        const { numbers, n, functions } = this,
            at = i * numbers * n + k,
            a = functions[at];
        if (numbers === 1) return [a * mx, a * my];
        const b = functions[at + n];
        if (numbers === 2) return [a * mx - b * my, a * my + b * mx];
        return [a * mx + b * my, functions[at + 2 * n] * mx + functions[at + 3 * n] * my];
    }

    add_function(i, mx, my) {
        const { n, dx, dy } = this,
            a = this.values(i, 0);
        if (this.numbers === 1) {
            for (let k = 0; k < n; ++k) {
                dx[k] += a[k] * mx;
                dy[k] += a[k] * my;
            }
        } else if (this.numbers === 2) {
            const b = this.values(i, 1);
            for (let k = 0; k < n; ++k) {
                dx[k] += a[k] * mx - b[k] * my;
                dy[k] += a[k] * my + b[k] * mx;
            }
        } else {
            const xy = this.values(i, 1),
                yx = this.values(i, 2),
                yy = this.values(i, 3);
            for (let k = 0; k < n; ++k) {
                dx[k] += a[k] * mx + xy[k] * my;
                dy[k] += yx[k] * mx + yy[k] * my;
            }
        }
    }
}
