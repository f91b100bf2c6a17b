"use strict";
// The selection holds the control points, or the rigid body, that the user has chosen.

class Selection {
    constructor(app) {
        this.app = app;
        this.points = new Set(); // in the order of the user's choice
        this.point = this.body = this.hovered = -1; // point is the one chosen last; -1: none
    }

    is_empty() {
        return this.point < 0 && this.body < 0;
    }

    // Chooses by the place in a list of control points, then bodies; -1 chooses none.
    choose(place) {
        const { n_control } = this.app.data;
        this.set(place >= 0 && place < n_control ? [place] : [], place < n_control ? -1 : place - n_control);
    }
    choose_body(body) {
        this.set([], body);
    }

    // Adds control points to the chosen ones; the last of them comes last also if it was chosen before.
    add(points) {
        const last = points[points.length - 1];
        this.set([...this.points, ...points].filter((point) => point !== last).concat(last ?? []));
    }
    add_or_remove(point) {
        if (this.points.has(point)) this.set([...this.points].filter((other) => other !== point));
        else this.add([point]);
    }

    set(points, body = -1) {
        this.points = new Set(points);
        this.point = points.length > 0 ? points[points.length - 1] : -1;
        this.body = body;
        this.app.set({});
        if (!this.is_empty()) this.app.panel.speak_choice();
    }

    // Returns the place of the last chosen one in the list.
    place() {
        return this.body < 0 ? this.point : this.app.data.n_control + this.body;
    }

    // Returns false at the end of the list, where the keyboard goes on to the page's next element.
    step(by) {
        const { n_control, bodies } = this.app.data,
            n = n_control + bodies.length,
            next = this.is_empty() ? (by > 0 ? 0 : n - 1) : this.place() + by;
        if (next < 0 || next >= n) return false;
        this.choose(next);
        return true;
    }
    // Begins again at the other end of the list.
    turn(by) {
        if (this.step(by)) return;
        this.choose(-1);
        this.step(by);
    }
    // Adds the control point after, or before, the one chosen last.
    extend(by) {
        const { n_control } = this.app.data;
        if (n_control > 0) this.add([this.point < 0 ? 0 : (this.point + by + n_control) % n_control]);
    }
    choose_all() {
        this.add([...Array(this.app.data.n_control).keys()]);
    }

    hover(point) {
        if (point === this.hovered) return;
        this.hovered = point;
        this.app.draw_soon();
    }

    name() {
        const { data } = this.app,
            more = this.points.size - 1;
        if (this.body >= 0) return `Body ${data.bodies[this.body].marker}`;
        if (more > 0) return `Point ${this.point + 1} and ${more} more`;
        if (this.point >= 0) return `Control point ${this.point + 1}`;
        return data.n_control > 0 ? "Control points" : "Bodies";
    }

    // Returns the section that the table describes.
    section() {
        const { sections } = this.app;
        return sections.find((section) => section.control.includes(this.point)) || sections[0];
    }

    // Returns the number of the function that is shown in colours: the function of the chosen point or body, or the
    // first.
    shown_function() {
        if (this.body >= 0) return this.app.data.n_control + 2 * this.body;
        return Math.max(this.point, 0);
    }
}
