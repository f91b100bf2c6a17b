"use strict";
// The view is the part of the plane that the stage shows, and the sizes of handles on the screen.

class View {
    constructor(app) {
        this.app = app;
        this.measure_bodies();
        this.home = this.box_of_what_moves();
        this.extent = Math.max(this.home[2] - this.home[0], this.home[3] - this.home[1]);
        this.unit = 1; // pixels per CSS pixel of a screen of usual size
    }

    // Sets the size of each rigid body, the larger side of the box round the body: the handle goes round the body.
    measure_bodies() {
        const { data, wall, model } = this.app;
        data.bodies.forEach((body, place) => {
            const faces = wall.faces.filter(({ marker }) => {
                const condition = condition_of(data, marker);
                return condition.kind === "rigid" && condition.body === place;
            });
            const box = box_of_points(model.x0, model.y0, faces.flatMap(({ a, b }) => [a, b]));
            body.size = Math.max(box[2] - box[0], box[3] - box[1]);
        });
    }

    // Returns the box round the walls that move and the control points, before anything moves.
    box_of_what_moves() {
        const { model, wall, curves } = this.app,
            box = box_of_points(
                model.x0,
                model.y0,
                wall.points.map((point) => point.point),
            );
        const { control0 } = curves;
        for (let i = 0; i < control0.length; i += 2) {
            box[0] = Math.min(box[0], control0[i]);
            box[1] = Math.min(box[1], control0[i + 1]);
            box[2] = Math.max(box[2], control0[i]);
            box[3] = Math.max(box[3], control0[i + 1]);
        }
        return box;
    }

    // The stage has another size. Letters and handles grow with the screen.
    resize() {
        const { camera } = this.app,
            { clientWidth: width, clientHeight: height } = element("stage");
        this.unit = parseFloat(getComputedStyle(document.documentElement).fontSize) / 15;
        camera.resize(width, height);
        if (camera.is_home) this.show_home();
    }

    fit() {
        this.show_home();
        this.app.draw_soon();
    }
    show_home() {
        this.app.camera.fit(this.home, 0.12);
        this.app.camera.is_home = true;
    }
    zoom(factor) {
        this.app.camera.zoom(factor);
        this.app.draw_soon();
    }

    // Shows the cell or the place of the wall that limits the movement.
    show_limit() {
        const { cells, model, camera, wall } = this.app,
            { touch } = wall,
            cell = cells.limiting >= 0 ? cells.limiting : cells.worst;
        if (cell < 0) return;
        const points = touch.point >= 0 ? [touch.point, touch.face.a, touch.face.b] : cells.corners(cell);
        camera.fit(box_of_points(model.x, model.y, points), 0.35);
        this.app.draw_soon();
    }

    // Returns a body's centre in the plane; the radius of the handle's circle and the place of its knob are in pixels.
    body_handle(place) {
        const { data, shape, camera } = this.app,
            { x, y, size } = data.bodies[place],
            position = shape.state.bodies[place];
        const angle = (position.degrees * Math.PI) / 180,
            radius = this.unit * Math.min(64, Math.max(26, 18 + 0.5 * size * camera.scale));
        return {
            x: x + position.x,
            y: y + position.y,
            radius,
            knob_x: camera.pixel_x(x + position.x) + radius * Math.cos(angle),
            knob_y: camera.pixel_y(y + position.y) - radius * Math.sin(angle),
        };
    }
}
