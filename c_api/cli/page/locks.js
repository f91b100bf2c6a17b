"use strict";
// Locks keep the area and the largest thickness of a section: after each movement, the control points that the user
// does not hold move by the smallest amount along the gradients of these measures that restores their values.

class Locks {
    constructor(app) {
        this.app = app;
        this.measures = []; // names of the locked measures: "area", "thickness"
    }

    toggle(name) {
        const kept = this.measures.filter((other) => other !== name);
        this.measures = kept.length < this.measures.length ? kept : [...kept, name];
    }

    // Corrects the state of the shape, so that the measures are those of the movements `start` again. held are control
    // points that stay at their places, unless a section would have no other ones.
    correct(start, held) {
        if (this.measures.length === 0) return;
        for (const section of this.app.sections) {
            const others = section.control.filter((i) => !held.has(i));
            this.correct_section(section, start, others.length > 1 ? others : section.control);
        }
    }

    // Newton's method; the gradients are those of the first step as long as each step gains a digit.
    correct_section(section, start, free) {
        const { points } = this.app.shape.state,
            goal = this.at(section, start).map(({ value }) => value),
            moves = this.app.shape.moves();
        let residual = Infinity,
            gradients = null;
        for (let turn = 0; turn < 20; ++turn) {
            const found = this.at(section, moves),
                errors = found.map(({ value }, k) => value / goal[k] - 1),
                largest = Math.max(...errors.map(Math.abs));
            if (!(largest > 1e-13)) return;
            if (gradients === null || !(largest < 0.1 * residual))
                gradients = found.map(({ gradient }, k) =>
                    free.flatMap((i) => [gradient[2 * i] / goal[k], gradient[2 * i + 1] / goal[k]]));
            residual = largest;
            const factors = Locks.solve(gradients, errors);
            if (factors === null) return;
            free.forEach((i, place) => {
                for (let axis = 0; axis < 2; ++axis) {
                    const change = gradients.reduce((sum, row, k) => sum - factors[k] * row[2 * place + axis], 0);
                    moves[2 * i + axis] += change;
                    points[2 * i + axis] += change;
                }
            });
        }
    }

    // Returns the locked measures of a section after the movements: { value, gradient } by the control points.
    at(section, moves) {
        const { curves } = this.app.model,
            moved = curves.moved(moves.subarray(0, 2 * curves.nControl)),
            { values, gradients } = moved.measure(["area", "maxThickness", "chord"], section.curves),
            n = 2 * curves.nControl,
            [area, thickness, chord] = values,
            row = (k) => gradients.subarray(k * n, (k + 1) * n);
        const all = {
            area: { value: area, gradient: row(0) },
            thickness: {
                value: thickness / chord,
                gradient: row(1).map((change, k) => (change - (thickness / chord) * row(2)[k]) / chord),
            },
        };
        return this.measures.map((name) => all[name]);
    }

    // Returns the factors of one or two gradients whose sum changes the measures by the errors; null if there are none.
    static solve(rows, errors) {
        const product = (one, other) => one.reduce((sum, value, k) => sum + value * other[k], 0),
            [a, b] = rows,
            aa = product(a, a);
        if (rows.length === 1) return aa > 0 ? [errors[0] / aa] : null;
        const ab = product(a, b),
            bb = product(b, b),
            determinant = aa * bb - ab * ab;
        if (!(determinant > 1e-12 * aa * bb)) return null;
        return [(bb * errors[0] - ab * errors[1]) / determinant, (aa * errors[1] - ab * errors[0]) / determinant];
    }
}
