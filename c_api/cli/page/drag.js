"use strict";
// Pointers and keys drag control points and bodies, pan and zoom: with mouse, pen, fingers or keyboard.

class Drag {
    constructor(canvas, app) {
        Object.assign(this, { canvas, app, pointers: new Map(), grip: null, mirrors: false });
        canvas.addEventListener("pointerdown", (event) => this.down(event));
        canvas.addEventListener("pointermove", (event) => this.move(event));
        canvas.addEventListener("pointerup", (event) => this.up(event));
        canvas.addEventListener("pointerleave", () => app.selection.hover(-1));
        canvas.addEventListener("pointercancel", (event) => this.up(event));
        canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
        window.addEventListener("keydown", (event) => this.key(event));
        window.addEventListener("dragover", (event) => event.preventDefault());
        window.addEventListener("drop", (event) => {
            event.preventDefault();
            if (event.dataTransfer.files.length > 0) app.files.open(event.dataTransfer.files[0]);
        });
    }

    place(event) {
        const box = this.canvas.getBoundingClientRect();
        return [event.clientX - box.left, event.clientY - box.top];
    }

    // Returns the handle under a pixel, {kind: "point" | "body" | "knob", place}, or null.
    find(px, py, reach) {
        const { app } = this,
            { camera, curves } = app;
        let best = null,
            least = reach;
        const offer = (kind, place, x, y) => {
            const distance = Math.hypot(x - px, y - py);
            if (distance < least) [best, least] = [{ kind, place }, distance];
        };
        app.data.bodies.forEach((_, place) => {
            const body = app.view.body_handle(place);
            offer("body", place, camera.pixel_x(body.x), camera.pixel_y(body.y));
            offer("knob", place, body.knob_x, body.knob_y);
        });
        if (!app.options.polygon) return best;
        for (let i = 0; i < app.data.n_control; ++i) {
            offer("point", i, camera.pixel_x(curves.control[2 * i]), camera.pixel_y(curves.control[2 * i + 1]));
        }
        return best;
    }

    down(event) {
        const { app, canvas } = this,
            [px, py] = this.place(event);
        canvas.focus();
        try {
            canvas.setPointerCapture(event.pointerId);
        } catch (error) {
            /* the pointer has gone already */
        }
        this.pointers.set(event.pointerId, [px, py]);
        if (this.pointers.size > 1) {
            this.release(); // two fingers zoom
            return;
        }
        const found = this.find(px, py, event.pointerType === "touch" ? 28 : 16);
        if (found !== null) this.grip = this.take(found, px, py, event.shiftKey);
        else this.grip = event.shiftKey ? { kind: "frame", px, py, to_x: px, to_y: py } : { kind: "plane" };
        canvas.classList.toggle("dragging", true);
        if (found !== null) app.said_hello();
    }

    // Returns the grip of a handle; a drag of one of several chosen points moves them all.
    take({ kind, place }, px, py, adds) {
        const { app } = this,
            { camera, selection } = app,
            x = camera.plane_x(px),
            y = camera.plane_y(py);
        if (kind === "point") {
            if (adds) selection.add_or_remove(place);
            else if (!selection.points.has(place)) selection.choose(place);
            return selection.points.has(place) ? { kind, x, y } : null;
        }
        selection.choose_body(place);
        const { degrees } = app.shape.state.bodies[place],
            handle = app.view.body_handle(place);
        return { kind, place, x, y, degrees, angle: Math.atan2(y - handle.y, x - handle.x) };
    }

    move(event) {
        const { app, canvas } = this,
            [px, py] = this.place(event);
        if (!this.pointers.has(event.pointerId)) {
            const near = this.find(px, py, 16);
            canvas.classList.toggle("near", near !== null);
            app.selection.hover(near !== null && near.kind === "point" ? near.place : -1);
            return;
        }
        const [old_x, old_y] = this.pointers.get(event.pointerId);
        if (this.pointers.size === 2) this.pinch(event.pointerId, px, py);
        this.pointers.set(event.pointerId, [px, py]);
        if (this.grip === null) return;
        if (this.grip.kind === "plane") {
            app.camera.pan(px - old_x, py - old_y);
            app.draw_soon();
        } else if (this.grip.kind === "frame") {
            Object.assign(this.grip, { to_x: px, to_y: py });
            app.draw_soon();
        } else {
            this.drag_to(app.camera.plane_x(px), app.camera.plane_y(py), event.altKey);
        }
    }

    // mirrors: the points across move the other way during this drag, whatever the user has chosen.
    drag_to(x, y, mirrors) {
        const { app, grip } = this;
        if (grip.kind !== "knob") {
            this.mirrors = mirrors;
            app.movement.move_choice_by(x - grip.x, y - grip.y, mirrors ? "mirror" : undefined);
            return;
        }
        const { degrees: last } = app.shape.state.bodies[grip.place],
            handle = app.view.body_handle(grip.place),
            turned = ((Math.atan2(y - handle.y, x - handle.x) - grip.angle) * 180) / Math.PI,
            degrees = grip.degrees + turned;
        app.movement.turn_choice(Number((degrees - 360 * Math.round((degrees - last) / 360)).toFixed(2)));
    }

    pinch(id, px, py) {
        const { app } = this,
            other = [...this.pointers].find(([key]) => key !== id)[1],
            mine = this.pointers.get(id);
        const before = Math.hypot(mine[0] - other[0], mine[1] - other[1]),
            after = Math.hypot(px - other[0], py - other[1]);
        app.camera.pan((px - mine[0]) / 2, (py - mine[1]) / 2);
        if (before > 0) app.camera.zoom(after / before, (px + other[0]) / 2, (py + other[1]) / 2);
        app.draw_soon();
    }

    // Ends a drag; the dragged handle stays at its place, and a frame chooses the points inside.
    release() {
        const { app, grip } = this;
        this.grip = null;
        this.mirrors = false;
        if (grip !== null && grip.kind === "frame") this.choose_inside(grip);
        else if (grip !== null && grip.kind !== "plane") app.commit();
    }

    choose_inside({ px, py, to_x, to_y }) {
        const { app } = this,
            { control } = app.curves,
            { camera, selection, options } = app,
            between = (a, b, c) => (a - b) * (a - c) <= 0;
        const inside = [...Array(options.polygon ? app.data.n_control : 0).keys()].filter(
            (i) =>
                between(camera.pixel_x(control[2 * i]), px, to_x) &&
                between(camera.pixel_y(control[2 * i + 1]), py, to_y),
        );
        if (inside.length > 0) selection.add(inside);
        app.draw_soon();
    }

    up(event) {
        if (!this.pointers.delete(event.pointerId)) return;
        this.release();
        this.canvas.classList.toggle("dragging", false);
    }

    wheel(event) {
        event.preventDefault();
        const step = event.deltaMode === 1 ? 30 * event.deltaY : event.deltaY;
        this.app.camera.zoom(Math.exp(-0.0015 * step), ...this.place(event));
        this.app.draw_soon();
    }

    key(event) {
        const { app } = this,
            typing = event.target.tagName === "INPUT" && event.target.type !== "range";
        const control = event.ctrlKey || event.metaKey,
            key = event.key.toLowerCase();
        const does = (action) => {
            event.preventDefault();
            action();
        };
        if (control && key === "s") return does(() => app.files.save());
        if (control && key === "o") return does(() => element("file").click());
        if (typing) return undefined;
        if (control && key === "z") return does(() => (event.shiftKey ? app.redo() : app.undo()));
        if (control && key === "y") return does(() => app.redo());
        const on_canvas = event.target === this.canvas || event.target === document.body;
        if (control && key === "a" && on_canvas) return does(() => app.selection.choose_all());
        if (control || element("keys").open) return undefined;
        if (on_canvas && key === "tab" && app.selection.step(event.shiftKey ? -1 : 1)) return does(() => {});
        const arrows = { arrowleft: [-1, 0], arrowright: [1, 0], arrowup: [0, 1], arrowdown: [0, -1] };
        if (on_canvas && key in arrows)
            return does(() => this.nudge(arrows[key], event.shiftKey ? 10 : event.altKey ? 0.1 : 1));
        const actions = {
            escape: () => app.selection.choose(-1),
            f: () => app.view.fit(),
            l: () => app.view.show_limit(),
            "+": () => app.view.zoom(1.4),
            "=": () => app.view.zoom(1.4),
            "-": () => app.view.zoom(1 / 1.4),
            b: () => app.toggle("before"),
            p: () => app.toggle("polygon"),
            t: () => app.switch_theme(),
            n: () => app.selection.extend(event.shiftKey ? -1 : 1),
            "?": () => element("keys").showModal(),
        };
        const colour = ["none", "quality", "angle", "height", "function"]["12345".indexOf(key)];
        if (colour) return does(() => document.querySelector(`#colour [data-value=${colour}]`).click());
        return key in actions ? does(actions[key]) : undefined;
    }

    nudge([right, up], factor) {
        const { app } = this,
            length = (app.view.extent / 1000) * factor;
        if (app.selection.is_empty()) {
            app.camera.pan(-40 * right, 40 * up);
            app.draw_soon();
            return;
        }
        app.commit();
        app.movement.move_choice_by(right * length, up * length);
        app.commit();
    }
}
