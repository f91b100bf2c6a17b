"use strict";
// The overlay lies over the mesh: walls, B-spline, control points, handles of bodies, marks of bad places, and the
// scale.

class Overlay {
    constructor(canvas, app) {
        this.canvas = canvas;
        this.context = canvas.getContext("2d");
        this.app = app;
    }

    draw(ratio) {
        const { context, canvas, app } = this,
            { camera } = app;
        canvas.width = Math.round(camera.width * ratio);
        canvas.height = Math.round(camera.height * ratio);
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        context.lineJoin = context.lineCap = "round";
        this.draw_walls();
        if (app.options.colour === "angle" || app.options.colour === "height") this.draw_ribbon();
        if (app.options.comb) this.draw_comb();
        if (app.options.polygon) this.draw_curves();
        this.draw_bad_cells();
        this.draw_limit();
        app.shape.state.bodies.forEach((body, place) => this.draw_body(place));
        if (app.options.polygon) this.draw_control_points();
        if (app.drag && app.drag.grip !== null && app.drag.grip.kind === "frame") this.draw_frame(app.drag.grip);
        this.draw_scale();
    }

    px(x) {
        return this.app.camera.pixel_x(x);
    }
    py(y) {
        return this.app.camera.pixel_y(y);
    }

    path_of_points(points, closed, x, y) {
        this.context.beginPath();
        for (const k of points) this.context.lineTo(this.px(x[k]), this.py(y[k]));
        if (closed) this.context.closePath();
    }

    path_of_pairs(pairs) {
        this.context.beginPath();
        for (let i = 0; i < pairs.length; i += 2) this.context.lineTo(this.px(pairs[i]), this.py(pairs[i + 1]));
    }

    stroke(name, width, dash = []) {
        this.context.strokeStyle = style_of(name);
        this.context.lineWidth = width;
        this.context.setLineDash(dash);
        this.context.stroke();
        this.context.setLineDash([]);
    }

    draw_walls() {
        const { app, context } = this,
            { model, wall } = app;
        for (const face of app.still_faces) {
            this.path_of_points([face.a, face.b], false, model.x, model.y);
            this.stroke("--wall", 1.5);
        }
        for (const chain of wall.chains) {
            this.path_of_points(chain.points, chain.closed, model.x, model.y);
            if (chain.closed && app.is_valid()) {
                // a filled invalid body might hide inverted cells
                context.fillStyle = style_of("--body");
                context.fill("evenodd");
            }
            this.stroke("--wall", 2.5);
            if (!app.options.before) continue;
            this.path_of_points(chain.points, chain.closed, model.x0, model.y0);
            this.stroke("--before", 2, [6, 4]);
        }
    }

    // Draws one stripe for each face along the wall, inside the body, in the colour of the point.
    draw_ribbon() {
        const { app, context } = this,
            { wall, model } = app,
            width = 9;
        context.lineCap = "butt";
        wall.layer.forEach((at, i) => {
            if (at.next < 0) return;
            const ax = this.px(model.x[at.point]),
                ay = this.py(model.y[at.point]);
            const bx = this.px(model.x[at.next]),
                by = this.py(model.y[at.next]),
                length = Math.hypot(bx - ax, by - ay);
            if (!(length > 0)) return;
            const nx = -(by - ay) / length,
                ny = (bx - ax) / length; // away from the mesh, as y runs down
            const shift = width / 2 + 1;
            context.beginPath();
            context.moveTo(ax + shift * nx, ay + shift * ny);
            context.lineTo(bx + shift * nx, by + shift * ny);
            context.strokeStyle = app.legend.wall_colour(i);
            context.lineWidth = width;
            context.stroke();
        });
        context.lineCap = "round";
    }

    draw_comb() {
        const { context, app } = this;
        for (const curve of app.curves.curves) {
            const [points, teeth] = app.curves.comb(curve, app.view.extent);
            context.beginPath();
            for (let i = 0; i < teeth.length; i += 2) {
                context.moveTo(this.px(points[i]), this.py(points[i + 1]));
                context.lineTo(this.px(teeth[i]), this.py(teeth[i + 1]));
            }
            this.stroke("--before", 0.75);
            this.path_of_pairs(teeth);
            this.stroke("--before", 1.5);
        }
    }

    draw_curves() {
        const { app, context } = this,
            { curves } = app;
        for (const curve of curves.curves) {
            if (app.options.before) {
                context.beginPath();
                for (const i of curves.polygon(curve)) {
                    context.lineTo(this.px(curves.control0[2 * i]), this.py(curves.control0[2 * i + 1]));
                }
                this.stroke("--before", 1, [2, 4]);
            }
            this.path_of_pairs(curves.outline(curve));
            this.stroke("--wall", 2.5);
            context.beginPath();
            for (const i of curves.polygon(curve)) {
                context.lineTo(this.px(curves.control[2 * i]), this.py(curves.control[2 * i + 1]));
            }
            this.stroke("--accent", 1.25, [5, 4]);
        }
    }

    draw_control_points() {
        const { app, context } = this,
            { control } = app.curves,
            { unit } = app.view,
            { points, hovered } = app.selection,
            follows = app.options.pair !== "alone" || app.drag.mirrors,
            partners = new Set(follows ? [...points].map((i) => app.pairs.partner[i]) : []);
        for (let i = 0; i < control.length / 2; ++i) {
            const x = this.px(control[2 * i]),
                y = this.py(control[2 * i + 1]);
            const chosen = points.has(i),
                near = i === hovered;
            if (chosen || near) {
                context.beginPath();
                context.arc(x, y, (chosen ? 15 : 13) * unit, 0, 7);
                context.fillStyle = style_of("--halo");
                context.fill();
            }
            context.beginPath();
            context.arc(x, y, (chosen || near ? 8 : 6) * unit, 0, 7);
            context.fillStyle = style_of(chosen || partners.has(i) ? "--accent" : "--handle");
            context.fill();
            this.stroke(chosen || partners.has(i) ? "--handle" : "--accent", 2.25);
            if (chosen || near) this.label(String(i + 1), x, y - 22 * unit);
        }
    }

    // Draws the frame that chooses control points.
    draw_frame({ px, py, to_x, to_y }) {
        this.context.beginPath();
        this.context.rect(px, py, to_x - px, to_y - py);
        this.context.fillStyle = style_of("--halo");
        this.context.fill();
        this.stroke("--accent", 1, [4, 4]);
    }

    label(text, x, y, name = "--ink") {
        const { context } = this;
        context.font = `600 ${14 * this.app.view.unit}px ${style_of("--font")}`;
        context.textAlign = "center";
        context.textBaseline = "middle";
        context.lineWidth = 4;
        context.strokeStyle = style_of("--canvas");
        context.strokeText(text, x, y);
        context.fillStyle = style_of(name);
        context.fillText(text, x, y);
    }

    draw_body(place) {
        const { app, context } = this,
            body = app.view.body_handle(place),
            chosen = app.selection.body === place;
        const x = this.px(body.x),
            y = this.py(body.y);
        context.beginPath();
        context.arc(x, y, body.radius, 0, 7);
        this.stroke("--accent", 1.5, [3, 5]);
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(body.knob_x, body.knob_y);
        this.stroke("--accent", 1.5);
        for (const [cx, cy, radius] of [
            [x, y, 10 * app.view.unit],
            [body.knob_x, body.knob_y, 8 * app.view.unit],
        ]) {
            context.beginPath();
            context.arc(cx, cy, radius, 0, 7);
            context.fillStyle = style_of(chosen ? "--accent" : "--handle");
            context.fill();
            this.stroke(chosen ? "--handle" : "--accent", 2.25);
        }
        context.beginPath();
        for (const [dx, dy] of [
            [5, 0],
            [0, 5],
        ]) {
            context.moveTo(x - dx, y - dy);
            context.lineTo(x + dx, y + dy);
        }
        this.stroke(chosen ? "--handle" : "--accent", 2);
    }

    // Marks inverted cells that are too small to be seen, and the places where the wall crosses itself.
    draw_bad_cells() {
        const { app, context } = this,
            { cells, model, camera, wall } = app;
        if (cells.inverted > 0) {
            context.fillStyle = style_of("--bad");
            for (let cell = 0, marked = 0; cell < cells.n && marked < 400; ++cell) {
                if (cells.quality[cell] > 0) continue;
                if (cells.size(cell, model.x0, model.y0) * camera.scale > 8) continue;
                const [x, y] = cells.centre(cell, model.x, model.y);
                context.beginPath();
                context.arc(this.px(x), this.py(y), 3, 0, 7);
                context.fill();
                ++marked;
            }
        }
        for (const [face] of wall.crossing.slice(0, 20)) {
            context.beginPath();
            context.arc(
                this.px((model.x[face.a] + model.x[face.b]) / 2),
                this.py((model.y[face.a] + model.y[face.b]) / 2),
                14,
                0,
                7,
            );
            this.stroke("--bad", 3);
        }
    }

    // Marks the cell that inverts first, or the place where the wall first touches itself, if the limit is near.
    draw_limit() {
        const { cells, model } = this.app,
            { touch } = this.app.wall,
            step = this.app.admissible_step();
        if (this.app.reached !== "" || !(step < 2) || (cells.limiting < 0 && touch.point < 0)) return;
        const [x, y] = touch.point >= 0
                ? [model.x[touch.point], model.y[touch.point]]
                : cells.centre(cells.limiting, model.x, model.y),
            px = this.px(x),
            py = this.py(y);
        this.context.beginPath();
        this.context.arc(px, py, 11, 0, 7);
        this.stroke(step <= 1 ? "--bad" : "--warn", 2.5);
    }

    draw_scale() {
        const { context, app } = this,
            { camera } = app,
            length = camera.round_length(140),
            pixels = length * camera.scale;
        const x = 24,
            y = camera.height - 24;
        context.beginPath();
        context.moveTo(x, y - 5);
        context.lineTo(x, y);
        context.lineTo(x + pixels, y);
        context.lineTo(x + pixels, y - 5);
        this.stroke("--ink", 1.5);
        this.label(brief(length), x + pixels / 2, y - 13 * app.view.unit, "--quiet");
    }
}
