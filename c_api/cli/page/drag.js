"use strict";
// Pointers and keys drag control points and bodies, pan and zoom: with mouse, pen, fingers or keyboard.

class Drag {
    constructor(canvas, app) {
        Object.assign(this, { canvas, app, pointers: new Map(), grip: null });
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
        this.grip = found === null ? { kind: "plane" } : this.take(found, px, py);
        canvas.classList.toggle("dragging", true);
        if (found !== null) app.said_hello();
    }

    take({ kind, place }, px, py) {
        const { app } = this,
            { camera } = app,
            x = camera.plane_x(px),
            y = camera.plane_y(py);
        if (kind === "point") {
            app.selection.choose(place);
            return { kind, place, x, y, dx: app.moves[2 * place], dy: app.moves[2 * place + 1] };
        }
        app.selection.choose_body(place);
        const body = app.shape.state.bodies[place],
            handle = app.view.body_handle(place);
        return { kind, place, x, y, start: { ...body }, angle: Math.atan2(y - handle.y, x - handle.x) };
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
        } else {
            this.drag_to(app.camera.plane_x(px), app.camera.plane_y(py));
        }
    }

    drag_to(x, y) {
        const { app, grip } = this;
        if (grip.kind === "point") {
            app.movement.move_point(
                grip.place,
                app.movement.rounded(grip.dx + x - grip.x),
                app.movement.rounded(grip.dy + y - grip.y),
            );
            return;
        }
        const body = app.shape.state.bodies[grip.place],
            handle = app.view.body_handle(grip.place);
        if (grip.kind === "body") {
            body.x = app.movement.rounded(grip.start.x + x - grip.x);
            body.y = app.movement.rounded(grip.start.y + y - grip.y);
        } else {
            const turned = ((Math.atan2(y - handle.y, x - handle.x) - grip.angle) * 180) / Math.PI;
            const degrees = grip.start.degrees + turned;
            body.degrees = Number((degrees - 360 * Math.round((degrees - body.degrees) / 360)).toFixed(2));
        }
        app.changed();
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

    // Ends a drag; the dragged handle stays at its place.
    release() {
        if (this.grip !== null && this.grip.kind !== "plane") this.app.commit();
        this.grip = null;
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
        if (control || element("keys").open) return undefined;
        const on_canvas = event.target === this.canvas || event.target === document.body;
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
            "?": () => element("keys").showModal(),
        };
        const colour = ["none", "quality", "angle", "height", "function"]["12345".indexOf(key)];
        if (colour) return does(() => document.querySelector(`#colour [data-value=${colour}]`).click());
        return key in actions ? does(actions[key]) : undefined;
    }

    nudge([right, up], factor) {
        const { app } = this,
            length = (app.view.extent / 1000) * factor;
        if (app.selection.body >= 0) {
            const body = app.shape.state.bodies[app.selection.body];
            body.x = app.movement.rounded(body.x + right * length);
            body.y = app.movement.rounded(body.y + up * length);
            app.changed();
        } else if (app.selection.point >= 0) {
            const i = app.selection.point;
            app.movement.move_point(
                i,
                app.movement.rounded(app.moves[2 * i] + right * length),
                app.movement.rounded(app.moves[2 * i + 1] + up * length),
            );
        } else {
            app.camera.pan(-40 * right, 40 * up);
            app.draw_soon();
            return;
        }
        app.commit();
    }
}
