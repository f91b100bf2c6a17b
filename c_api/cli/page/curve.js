"use strict";
// The B-spline curves as they are drawn.

// Returns [first curve, number of curves] of each outline: a curve that has an end in common with the one before
// belongs to its outline, as a blunt base does.
function outlines_of(curves) {
    const ends = ({ indices }) => [indices[0], indices[indices.length - 1]],
        outlines = [];
    curves.forEach((curve, k) => {
        const last = outlines[outlines.length - 1];
        if (k > 0 && ends(curve).some((end) => ends(curves[k - 1]).includes(end))) ++last[1];
        else outlines.push([k, 1]);
    });
    return outlines;
}

class Curves {
    constructor(data, model) {
        this.model = model;
        this.control0 = data.control;
        this.control = data.control.slice(); // after the movement
        this.now = model.curves; // of the library
        this.curves = data.curves.map((curve, number) => Object.assign({ number, u: Curves.parameters(curve) }, curve));
    }

    move(moves) {
        if (this.now === null) return;
        this.now = this.model.curves.moved(moves.subarray(0, this.control0.length));
        this.control.set(this.now.control);
    }

    // Returns x,y pairs along a curve.
    outline({ number, u }) {
        return this.now.points(u, { curve: number });
    }

    // Returns the curvature comb: points of the curve, and the other ends of the teeth, which are at right angles to the
    // curve, on its right where it turns left. Their length is .02 chord sqrt(chord |curvature|), so that teeth at the
    // leading edge and along the sides are visible together.
    comb({ number, u }, chord) {
        const of = (derivative) => this.now.points(u, { curve: number, derivative }),
            [points, along, bend] = [of(0), of(1), of(2)],
            teeth = points.slice();
        for (let k = 0; k < points.length; k += 2) {
            const [x, y] = along.subarray(k, k + 2),
                speed = Math.hypot(x, y),
                turn = x * bend[k + 1] - y * bend[k];
            if (!(speed > 0)) continue;
            const size = (0.02 * chord * Math.sqrt((chord * Math.abs(turn)) / speed)) / speed / speed,
                factor = turn < 0 ? -size : size;
            teeth[k] += factor * y;
            teeth[k + 1] -= factor * x;
        }
        return [points, teeth];
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

    // Returns equally spaced parameters in each span between two knots.
    static parameters({ degree, knots, indices }, per_span = 16) {
        const u = [knots[degree]];
        for (let span = degree; span < indices.length; ++span) {
            const length = knots[span + 1] - knots[span];
            for (let i = 1; i <= per_span && length > 0; ++i)
                u.push(i === per_span ? knots[span + 1] : knots[span] + (length * i) / per_span);
        }
        return u;
    }
}
