"use strict";
// Locks keep the area and the largest thickness of a section: after each movement, the control points that the user
// does not hold move by the smallest amount along the gradients of these measures that restores their values.

class Locks {
    constructor(app) {
        this.app = app;
        this.measures = []; // names of the locked measures: "area", "thickness"
        this.x = new Float64Array(app.model.n);
        this.y = new Float64Array(app.model.n);
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
            if (section.control.length > 0)
                this.correct_section(section, start, others.length > 1 ? others : section.control);
        }
    }

    correct_section(section, start, free) {
        const { points } = this.app.shape.state,
            goal = this.at(section, start),
            moves = this.app.shape.moves();
        let residual = Infinity,
            gradients = null;
        for (let turn = 0; turn < 20; ++turn) {
            const errors = this.at(section, moves).map((value, k) => value / goal[k] - 1),
                largest = Math.max(...errors.map(Math.abs));
            if (!(largest > 1e-13)) return;
            if (gradients === null || !(largest < 0.1 * residual)) gradients = this.gradients(section, goal, free);
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

    // Returns the locked measures of a section after the movements; leaves the moved wall in x and y.
    at(section, moves) {
        const { model } = this.app;
        for (const k of section.points) [this.x[k], this.y[k]] = [model.x0[k], model.y0[k]];
        for (let i = 0; i < model.n_functions; ++i) {
            if (moves[2 * i] !== 0 || moves[2 * i + 1] !== 0) this.shift(section, i, moves[2 * i], moves[2 * i + 1]);
        }
        return this.measured(section);
    }
    measured(section) {
        const all = section.measure(this.x, this.y);
        return this.measures.map((name) => all[name]);
    }
    shift(section, i, mx, my) {
        for (const k of section.points) {
            const [dx, dy] = this.app.model.displacement(i, k, mx, my);
            this.x[k] += dx;
            this.y[k] += dy;
        }
    }

    // Returns the gradients of the measures, in parts of their goals, with respect to dx, dy of the free control
    // points, by central differences round the wall in x and y.
    gradients(section, goal, free) {
        const step = 1e-6 * section.frame.chord,
            rows = goal.map(() => new Float64Array(2 * free.length));
        free.forEach((i, place) => {
            for (let axis = 0; axis < 2; ++axis) {
                const by = (length) => this.shift(section, i, axis === 0 ? length : 0, axis === 0 ? 0 : length);
                by(step);
                const ahead = this.measured(section);
                by(-2 * step);
                const behind = this.measured(section);
                by(step);
                rows.forEach((row, k) => {
                    row[2 * place + axis] = (ahead[k] - behind[k]) / (2 * step * goal[k]);
                });
            }
        });
        return rows;
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
