"use strict";
// The B-spline curves are C(u) = sum_k N_k(u) P[indices[k]], and rational where there are weights.

class Curves {
    constructor(data) {
        this.weights = data.weights;
        this.control0 = data.control;
        this.control = data.control.slice(); // after the movement
        this.curves = data.curves.map((curve) => Object.assign({ samples: this.tabulate(curve) }, curve));
    }

    move(moves) {
        for (let i = 0; i < this.control.length; ++i) this.control[i] = this.control0[i] + moves[i];
    }

    // Returns x,y pairs along a curve.
    outline(curve, control = this.control) {
        const line = new Float64Array(2 * curve.samples.length);
        curve.samples.forEach((sample, place) => {
            let x = 0,
                y = 0,
                w = 0;
            for (let k = 0; k <= curve.degree; ++k) {
                const index = curve.indices[sample.first + k];
                const value = sample.values[k] * (this.weights.length > 0 ? this.weights[index] : 1);
                x += value * control[2 * index];
                y += value * control[2 * index + 1];
                w += value;
            }
            line[2 * place] = x / w;
            line[2 * place + 1] = y / w;
        });
        return line;
    }

    // Returns the leading-edge radius and the trailing-edge angle [degrees] of an outline that begins and ends at its
    // trailing edge. The leading edge is the point farthest from there. A periodic curve has no ends, and returns
    // nothing.
    edges(number) {
        const curve = this.curves[number],
            { degree, knots, indices } = curve,
            first = knots[degree],
            last = knots[indices.length],
            small = 1e-6 * (last - first),
            begin = this.point(curve, first),
            end = this.point(curve, last);
        if (knots[0] !== first) return {};
        const edge = [(begin[0] + end[0]) / 2, (begin[1] + end[1]) / 2],
            distance = (u) => Math.hypot(...minus(this.point(curve, u), edge));
        let low = first,
            high = last;
        for (let n = 400, step = (last - first) / n, i = 0, most = 0; i <= n; ++i) {
            if (distance(first + i * step) <= most) continue;
            most = distance(first + i * step);
            [low, high] = [Math.max(first + (i - 1) * step, first), Math.min(first + (i + 1) * step, last)];
        }
        while (high - low > 1e-12 * (last - first)) {
            const one = low + (high - low) / 3,
                other = high - (high - low) / 3;
            if (distance(one) > distance(other)) high = other;
            else low = one;
        }
        // The radius is the one of the circle through three points.
        const [a, b, c] = [low - small, low, low + small].map((u) => this.point(curve, u)),
            [ab, bc, ca] = [minus(b, a), minus(c, b), minus(a, c)],
            twice_area = Math.abs(ab[0] * bc[1] - ab[1] * bc[0]),
            leading_edge_radius = (Math.hypot(...ab) * Math.hypot(...bc) * Math.hypot(...ca)) / (2 * twice_area);
        const ahead = minus(this.point(curve, first + small), begin),
            behind = minus(this.point(curve, last - small), end),
            trailing_edge_angle = (Math.abs(turn_between(...ahead, ...behind)) * 180) / Math.PI;
        return { leading_edge_radius, trailing_edge_angle };
    }

    point(curve, u) {
        const { degree, knots, indices } = curve;
        let span = degree,
            x = 0,
            y = 0,
            w = 0;
        while (span + 1 < indices.length && knots[span + 1] <= u) ++span;
        this.functions_at(curve, span, u).forEach((number, k) => {
            const index = indices[span - degree + k],
                value = number * (this.weights.length > 0 ? this.weights[index] : 1);
            x += value * this.control[2 * index];
            y += value * this.control[2 * index + 1];
            w += value;
        });
        return [x / w, y / w];
    }

    // Returns the control points of a curve in order; the polygon of a closed curve ends with the first point.
    polygon(curve) {
        const indices = [];
        for (const index of curve.indices) {
            indices.push(index);
            if (indices.length > 1 && index === indices[0]) break;
        }
        return indices;
    }

    // Tabulates the functions that are not 0 at equally spaced parameters in each span between two knots.
    tabulate(curve) {
        const samples = [],
            per_span = 16,
            { degree, knots } = curve,
            n = curve.indices.length;
        for (let span = degree; span < n; ++span) {
            const begin = knots[span],
                end = knots[span + 1];
            if (!(begin < end)) continue;
            for (let i = samples.length === 0 ? 0 : 1; i <= per_span; ++i) {
                const u = begin + ((end - begin) * i) / per_span;
                samples.push({ first: span - degree, values: this.functions_at(curve, span, u) });
            }
        }
        return samples;
    }

    // Returns the functions that are not 0 in a span (Piegl and Tiller, The NURBS Book, algorithm A2.2).
    functions_at(curve, span, u) {
        const { degree, knots } = curve,
            values = [1],
            left = [0],
            right = [0];
        for (let j = 1; j <= degree; ++j) {
            left[j] = u - knots[span + 1 - j];
            right[j] = knots[span + j] - u;
            let saved = 0;
            for (let r = 0; r < j; ++r) {
                const share = values[r] / (right[r + 1] + left[j - r]);
                values[r] = saved + right[r + 1] * share;
                saved = left[j - r] * share;
            }
            values[j] = saved;
        }
        return values;
    }
}

function minus([ax, ay], [bx, by]) {
    return [ax - bx, ay - by];
}
