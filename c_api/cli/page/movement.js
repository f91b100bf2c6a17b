"use strict";
// Movements of what is chosen, in lengths of the mesh.

class Movement {
    constructor(app) {
        this.app = app;
        this.digit = 10 ** (Math.floor(Math.log10(app.view.extent)) - 5); // dragged movements are multiples of it
    }

    rounded(length) {
        return Number((Math.round(length / this.digit) * this.digit).toPrecision(12));
    }

    // Sets the movement of a control point; the point across follows as the user has chosen.
    move_point(index, dx, dy) {
        const { app } = this,
            old_dx = app.moves[2 * index],
            old_dy = app.moves[2 * index + 1],
            partner = this.partner_of(index);
        app.shape.set_point(index, dx, dy);
        if (partner >= 0) {
            const [px, py] = app.pairs.partner_moves(app.options.pair, index, dx - old_dx, dy - old_dy);
            app.shape.set_point(
                partner,
                this.rounded(app.moves[2 * partner] + px),
                this.rounded(app.moves[2 * partner + 1] + py),
            );
        }
        app.changed();
    }

    // Returns the control point that moves together with another one, or -1.
    partner_of(index) {
        return index < 0 || this.app.options.pair === "alone" ? -1 : this.app.pairs.partner[index];
    }

    // Returns the movement of the control point or body that is chosen.
    of_choice() {
        const { selection, shape, moves } = this.app;
        if (selection.body >= 0) {
            const { x, y } = shape.state.bodies[selection.body];
            return [x, y];
        }
        return selection.point < 0 ? [0, 0] : [moves[2 * selection.point], moves[2 * selection.point + 1]];
    }
    move_choice(dx, dy) {
        const { selection, shape } = this.app;
        if (selection.body >= 0) {
            Object.assign(shape.state.bodies[selection.body], { x: dx, y: dy });
            this.app.changed();
        } else if (selection.point >= 0) {
            this.move_point(selection.point, dx, dy);
        }
    }
}
