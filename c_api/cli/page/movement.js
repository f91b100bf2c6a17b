"use strict";
// Movements of what is chosen, in units of the mesh. Until a movement is finished, each part of it begins again at the
// last finished state, so that the way of the pointer does not matter.

class Movement {
    constructor(app) {
        this.app = app;
        this.digit = 10 ** (Math.floor(Math.log10(app.view.extent)) - 5); // dragged movements are multiples of it
        this.locks = new Locks(app);
        this.source = null; // the control that makes the present change
    }

    rounded(length) {
        return Number((Math.round(length / this.digit) * this.digit).toPrecision(12));
    }

    // Makes a change that source (a field, a slider, the pointer) has not finished yet. action() changes the state and
    // may return the control points that locks must not move.
    change(source, action) {
        const { shape } = this.app;
        if (source !== this.source) this.app.commit();
        this.source = source;
        shape.restart();
        const start = shape.moves(),
            held = action(start) || new Set();
        this.locks.correct(start, held);
        this.app.changed();
    }

    // Sets the movements of control points, by index. Points across that are not among them follow as pair says.
    move_points(movements, pair = this.app.options.pair, source = "points") {
        const { shape, pairs } = this.app;
        this.change(source, (start) => {
            const held = new Set(movements.keys());
            for (const [i, [dx, dy]] of movements) {
                const j = pair === "alone" ? -1 : pairs.partner[i];
                shape.set_point(i, dx, dy);
                if (j < 0 || movements.has(j)) continue;
                const [px, py] = pairs.partner_moves(pair, i, dx - start[2 * i], dy - start[2 * i + 1]);
                shape.set_point(j, this.rounded(start[2 * j] + px), this.rounded(start[2 * j + 1] + py));
                held.add(j);
            }
            return held;
        });
    }
    move_point(index, dx, dy) {
        this.move_points(new Map([[index, [dx, dy]]]));
    }

    // Moves the chosen points or the chosen body by so much; pair overrides the user's choice.
    move_choice_by(dx, dy, pair) {
        const { selection, shape } = this.app,
            by = (x, y) => [this.rounded(x + dx), this.rounded(y + dy)];
        if (selection.body >= 0) {
            this.change("body", () => {
                const body = shape.state.bodies[selection.body];
                [body.x, body.y] = by(body.x, body.y);
            });
            return;
        }
        const start = shape.finished_moves(),
            movements = [...selection.points].map((i) => [i, by(start[2 * i], start[2 * i + 1])]);
        this.move_points(new Map(movements), pair);
    }

    // Sets the movement of the chosen body, or of the point chosen last; the other chosen points move by as much.
    move_choice(dx, dy, source) {
        const { selection, shape } = this.app;
        if (selection.body >= 0) {
            this.change(source, () => void Object.assign(shape.state.bodies[selection.body], { x: dx, y: dy }));
        } else if (selection.point >= 0) {
            const start = shape.finished_moves(),
                last = selection.point,
                by_x = dx - start[2 * last],
                by_y = dy - start[2 * last + 1],
                movements = [...selection.points].map((i) => [i, [start[2 * i] + by_x, start[2 * i + 1] + by_y]]);
            this.move_points(new Map(movements).set(last, [dx, dy]), undefined, source);
        }
    }

    // Turns the chosen body.
    turn_choice(degrees) {
        const { selection, shape } = this.app;
        this.change("body", () => void Object.assign(shape.state.bodies[selection.body], { degrees }));
    }

    // Returns the movement of the chosen body, or of the control point chosen last.
    of_choice() {
        const { selection, shape, moves } = this.app;
        if (selection.body >= 0) {
            const { x, y } = shape.state.bodies[selection.body];
            return [x, y];
        }
        return selection.point < 0 ? [0, 0] : [moves[2 * selection.point], moves[2 * selection.point + 1]];
    }
}
