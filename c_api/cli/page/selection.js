"use strict";
// The selection is the control point or the rigid body that the user has chosen.

class Selection {
    constructor(app) {
        this.app = app;
        this.point = this.body = this.hovered = -1; // -1: none
    }

    is_empty() {
        return this.point < 0 && this.body < 0;
    }

    // Chooses by the place in a list of control points, then bodies; -1 chooses none.
    choose(place) {
        const { n_control } = this.app.data;
        this.point = place < n_control ? place : -1;
        this.body = place < n_control ? -1 : place - n_control;
        this.app.set({});
        if (place >= 0) this.app.panel.speak_choice();
    }
    choose_body(body) {
        this.choose(this.app.data.n_control + body);
    }
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

    hover(point) {
        if (point === this.hovered) return;
        this.hovered = point;
        this.app.draw_soon();
    }

    name() {
        const { data } = this.app;
        if (this.body >= 0) return `Body ${data.bodies[this.body].marker}`;
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
