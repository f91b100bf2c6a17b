"use strict";
// The page: what is shown and chosen, and what follows when something moves.

class App {
    constructor(raw) {
        const data = (this.data = decode(raw));
        this.model = new Model(data);
        this.cells = new Cells(data, this.model);
        this.curves = new Curves(data);
        this.wall = new Wall(data, this.model);
        this.sections = this.wall.chains
            .filter((chain) => chain.closed && data.markers[chain.marker].kind === "curve")
            .map((chain) => new Section(chain, data, this.model, this.curves));
        this.pairs = new Pairs(data, this.sections);
        this.shape = new Shape(data, this.sections);
        this.still_faces = this.wall.faces.filter((face) => !this.wall.moves[face.marker]);
        this.measure_bodies();
        this.home = this.box_of_what_moves();
        this.extent = Math.max(this.home[2] - this.home[0], this.home[3] - this.home[1]);
        this.digit = 10 ** (Math.floor(Math.log10(this.extent)) - 5); // dragged movements are multiples of it
        this.options = { colour: "none", before: false, polygon: true, pair: "alone", theme: this.theme_of_system() };
        this.selected = this.hovered = this.chosen_body = -1;
        this.moves = this.shape.moves();
        this.still = true;
        this.times = { morph: 0, judge: 0, draw: 0 }; // of the last frame [ms]
        this.camera = new Camera();
        this.legend = new Legend(this);
        this.files = new Files(this);
        this.picture = new Picture(data, this.model, this.cells, make_painter(element("mesh"), data.pieces.points));
        this.overlay = new Overlay(element("handles"), this);
        this.set_theme(this.options.theme);
        this.panel = new Panel(this);
        this.drag = new Drag(element("handles"), this);
        this.connect_buttons();
        this.say_what_is_left_out();
        new ResizeObserver(() => this.resize()).observe(element("stage"));
        this.camera.is_home = true;
        this.resize();
        if (data.moves !== "") this.files.load(data.moves);
        this.follow();
        this.draw();
    }

    // The larger side of the box round each rigid body: its handle goes round it.
    measure_bodies() {
        this.data.bodies.forEach((body, place) => {
            const faces = this.wall.faces.filter(({ marker }) => {
                const { kind, body: its } = this.data.markers[marker];
                return kind === "rigid" && its === place;
            });
            const box = box_of_points(this.model.x0, this.model.y0, faces.map((face) => face.a));
            body.size = Math.max(box[2] - box[0], box[3] - box[1]);
        });
    }

    box_of_what_moves() {
        const { x0, y0 } = this.model,
            box = box_of_points(
                x0,
                y0,
                this.wall.points.map((wall) => wall.point),
            );
        const { control0 } = this.curves;
        for (let i = 0; i < control0.length; i += 2) {
            box[0] = Math.min(box[0], control0[i]);
            box[1] = Math.min(box[1], control0[i + 1]);
            box[2] = Math.max(box[2], control0[i]);
            box[3] = Math.max(box[3], control0[i + 1]);
        }
        return box;
    }

    connect_buttons() {
        const on = (id, action) => {
            element(id).onclick = action;
        };
        on("fit", () => this.fit());
        on("zoom_in", () => this.zoom(1.4));
        on("zoom_out", () => this.zoom(1 / 1.4));
        on("before", () => this.toggle("before"));
        on("polygon", () => this.toggle("polygon"));
        on("bad_cell", () => this.show_limit());
        on("theme", () => this.switch_theme());
        on("help", () => {
            const { morph, judge, draw } = this.times;
            element("timing").textContent =
                `Last frame: ${brief(morph + judge + draw)} ms (morph ${brief(morph)}, judge ${brief(judge)}, ` +
                `draw ${brief(draw)}). harmorph ${this.data.version}.`;
            element("keys").showModal();
        });
        on("undo", () => this.undo());
        on("redo", () => this.redo());
        on("reset", () => this.after(() => this.shape.reset()));
        on("load", () => element("file").click());
        on("save", () => this.files.save());
        on("previous", () => this.turn_selection(-1));
        on("next", () => this.turn_selection(1));
        on("back_to_valid", () => this.after(() => this.shape.back_to_valid()));
        on("save_section", () => this.files.save_section());
        on("save_picture", () => this.files.save_picture());
        element("file").onchange = (event) => {
            if (event.target.files.length > 0) this.files.open(event.target.files[0]);
            event.target.value = "";
        };
    }

    say_what_is_left_out() {
        const { data } = this,
            note = element("left_out"),
            rest = data.all_cells - data.cells;
        note.hidden = rest === 0;
        note.textContent =
            `${data.cells.toLocaleString("en")} of ${data.all_cells.toLocaleString("en")} cells are shown and judged; ` +
            "farther away the mesh is thinned";
    }

    // ---- Movements

    // A control point's movement becomes this; the point across follows as the user has chosen.
    move_point(index, dx, dy) {
        const was = [this.moves[2 * index], this.moves[2 * index + 1]],
            partner = this.partner_of(index);
        this.shape.set_point(index, dx, dy);
        if (partner >= 0) {
            const [px, py] = this.pairs.partner_moves(this.options.pair, index, dx - was[0], dy - was[1]);
            this.shape.set_point(
                partner,
                this.rounded(this.moves[2 * partner] + px),
                this.rounded(this.moves[2 * partner + 1] + py),
            );
        }
        this.changed();
    }

    partner_of(index) {
        return index < 0 || this.options.pair === "alone" ? -1 : this.pairs.partner[index];
    }

    rounded(length) {
        return Number((Math.round(length / this.digit) * this.digit).toPrecision(12));
    }

    changed() {
        this.moves = this.shape.moves();
        this.said_hello();
        this.must_follow = true;
        this.draw_soon();
    }

    commit() {
        if (!this.shape.commit()) return;
        if (this.must_follow) this.follow();
        this.panel.update();
        this.panel.speak_verdict();
    }

    after(action) {
        this.drag.release();
        action();
        this.changed();
        this.follow();
        this.panel.speak_verdict();
    }
    undo() {
        this.after(() => this.shape.undo());
    }
    redo() {
        this.after(() => this.shape.redo());
    }

    // The movement of the control point or body that is chosen.
    chosen_movement() {
        if (this.chosen_body >= 0) {
            const { x, y } = this.shape.state.bodies[this.chosen_body];
            return [x, y];
        }
        return this.selected < 0 ? [0, 0] : [this.moves[2 * this.selected], this.moves[2 * this.selected + 1]];
    }
    move_chosen(dx, dy) {
        if (this.chosen_body >= 0) {
            Object.assign(this.shape.state.bodies[this.chosen_body], { x: dx, y: dy });
            this.changed();
        } else if (this.selected >= 0) {
            this.move_point(this.selected, dx, dy);
        }
    }
    name_of_choice() {
        if (this.chosen_body >= 0) return `Body ${this.data.bodies[this.chosen_body].marker}`;
        if (this.selected >= 0) return `Control point ${this.selected + 1}`;
        return this.data.n_control > 0 ? "Control points" : "Bodies";
    }

    // The mesh where the movements put it, and what it is worth.
    follow() {
        const begin = performance.now();
        this.must_follow = false;
        this.still = this.moves.every((move) => move === 0);
        this.curves.move(this.moves);
        this.model.morph(this.moves);
        const morphed = performance.now();
        this.cells.judge();
        this.wall.judge(this.cells.step);
        for (const section of this.sections) section.judge();
        if (this.is_valid()) this.shape.remember_valid();
        Object.assign(this.times, { morph: morphed - begin, judge: performance.now() - morphed });
        this.panel.update();
    }

    draw_soon() {
        if (this.frame) return;
        this.frame = requestAnimationFrame(() => {
            this.frame = 0;
            if (this.must_follow) this.follow();
            this.draw();
        });
    }

    draw() {
        const begin = performance.now();
        this.picture.draw(this.camera, devicePixelRatio, this.options);
        this.overlay.draw(devicePixelRatio);
        this.times.draw = performance.now() - begin;
    }

    is_valid() {
        return this.cells.inverted === 0 && this.wall.crossing.length === 0;
    }

    // The fraction of the movement up to which no cell is inverted and the wall does not touch itself.
    admissible_step() {
        return Math.min(this.cells.step, this.wall.touch.step);
    }

    said_hello() {
        element("hint").classList.add("gone");
    }

    // ---- View

    resize() {
        this.unit = parseFloat(getComputedStyle(document.documentElement).fontSize) / 15; // letters grow with the screen
        const { clientWidth: width, clientHeight: height } = element("stage");
        this.camera.resize(width, height);
        if (this.camera.is_home) this.show_home();
        if (this.panel) this.draw(); // at once, or the old picture would be stretched for a moment
    }
    fit() {
        this.show_home();
        this.draw_soon();
    }
    show_home() {
        this.camera.fit(this.home, 0.12);
        this.camera.is_home = true;
    }
    zoom(factor) {
        this.camera.zoom(factor);
        this.draw_soon();
    }
    show_limit() {
        const { cells, model, camera } = this,
            { touch } = this.wall,
            cell = cells.limiting >= 0 ? cells.limiting : cells.worst;
        if (cell < 0) return;
        const points = touch.point >= 0 ? [touch.point, touch.face.a, touch.face.b] : cells.corners(cell);
        camera.fit(box_of_points(model.x, model.y, points), 0.35);
        this.draw_soon();
    }

    set(options) {
        Object.assign(this.options, options);
        this.show_function();
        this.panel.update();
        this.draw_soon();
    }
    toggle(name) {
        this.set({ [name]: !this.options[name] });
        element(name).setAttribute("aria-pressed", this.options[name]);
    }

    // Control points, then bodies; -1: none of them.
    select(index) {
        const { n_control } = this.data;
        this.selected = index < n_control ? index : -1;
        this.chosen_body = index < n_control ? -1 : index - n_control;
        this.set({});
        if (index >= 0) this.panel.speak_choice();
    }
    choose_body(place) {
        this.select(this.data.n_control + place);
    }
    choice() {
        return this.chosen_body < 0 ? this.selected : this.data.n_control + this.chosen_body;
    }
    // False at the end of the list, where the keyboard goes on to the page's next element.
    step_selection(by) {
        const n = this.data.n_control + this.data.bodies.length,
            next = this.choice() < 0 ? (by > 0 ? 0 : n - 1) : this.choice() + by;
        if (next < 0 || next >= n) return false;
        this.select(next);
        return true;
    }
    // The same without an end.
    turn_selection(by) {
        if (this.step_selection(by)) return;
        this.select(-1);
        this.step_selection(by);
    }
    hover(index) {
        if (index === this.hovered) return;
        this.hovered = index;
        this.draw_soon();
    }

    // A body's centre in the plane; the knob to turn it, and the circle it is on, in pixels.
    body_handle(place) {
        const { x, y, size } = this.data.bodies[place],
            its = this.shape.state.bodies[place],
            { camera } = this;
        const angle = (its.degrees * Math.PI) / 180,
            radius = this.unit * Math.min(64, Math.max(26, 18 + 0.5 * size * camera.scale));
        return {
            x: x + its.x,
            y: y + its.y,
            radius,
            knob_x: camera.pixel_x(x + its.x) + radius * Math.cos(angle),
            knob_y: camera.pixel_y(y + its.y) - radius * Math.sin(angle),
        };
    }

    current_section() {
        return this.sections.find((section) => section.control.includes(this.selected)) || this.sections[0];
    }

    // ---- Colours

    theme_of_system() {
        return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
    }
    set_theme(theme) {
        this.options.theme = theme;
        document.documentElement.classList.toggle("dark", theme === "dark");
    }
    switch_theme() {
        this.set_theme(this.options.theme === "dark" ? "light" : "dark");
        this.set({});
    }

    // The function of the chosen point, or body, or else of the first.
    shown_function() {
        if (this.chosen_body >= 0) return this.data.n_control + 2 * this.chosen_body;
        return Math.max(this.selected, 0);
    }
    show_function() {
        if (this.options.colour === "function")
            this.picture.values = this.model.size_of_function(this.shown_function());
    }
}

const app = new App(page_data);
