"use strict";
// The page: its parts, its buttons, and what follows when something moves.

class App {
    constructor(raw, classes) {
        const data = (this.data = decode(raw));
        this.model = new Model(data, classes);
        data.pieces = pieces_of(data, data.x, data.y);
        data.n_functions = this.model.n_functions;
        this.cells = new Cells(data, new Float64Array(this.model.n_cells), this.model);
        this.curves = new Curves(data, this.model);
        this.wall = new Wall(data, this.model);
        this.sections = this.find_sections();
        this.pairs = new Pairs(data, this.sections);
        this.shape = new Shape(data, this.sections, this.model);
        this.still_faces = this.wall.faces.filter((face) => !this.wall.moves[face.marker]);
        this.options = { colour: "none", before: false, polygon: true, pair: "alone", theme: theme_of_system() };
        Object.assign(this.options, { comb: false, pressure: false, attack: 2 }); // the angle of attack is in degrees
        this.moves = this.shape.moves();
        this.still = true;
        this.reached = ""; // how the mesh was reached, if not by the functions alone
        this.displaced = false; // by displacements of wall points, which are no movement of control points
        this.times = { morph: 0, judge: 0, draw: 0 }; // of the last frame [ms]
        this.camera = new Camera();
        this.view = new View(this);
        this.selection = new Selection(this);
        this.movement = new Movement(this);
        this.legend = new Legend(this);
        this.files = new Files(this);
        this.farther = new Farther(this);
        this.picture = new Picture(data, this.model, this.cells, make_painter(element("mesh"), data.pieces.points));
        this.overlay = new Overlay(element("handles"), this);
        this.set_theme(this.options.theme);
        this.panel = new Panel(this);
        this.drag = new Drag(element("handles"), this);
        this.connect_buttons();
        this.camera.is_home = true;
        this.view.resize();
        new ResizeObserver(() => this.resize()).observe(element("stage"));
        if (data.moves !== "") this.files.load(data.moves);
        this.follow();
        this.draw();
    }

    connect_buttons() {
        const on = (id, action) => {
            element(id).onclick = action;
        };
        on("fit", () => this.view.fit());
        on("zoom_in", () => this.view.zoom(1.4));
        on("zoom_out", () => this.view.zoom(1 / 1.4));
        on("before", () => this.toggle("before"));
        on("polygon", () => this.toggle("polygon"));
        on("bad_cell", () => this.view.show_limit());
        on("theme", () => this.switch_theme());
        on("help", () => this.show_keys());
        on("undo", () => this.undo());
        on("redo", () => this.redo());
        on("reset", () => this.after(() => this.shape.reset()));
        on("load", () => element("file").click());
        on("save", () => this.files.save());
        on("previous", () => this.selection.turn(-1));
        on("next", () => this.selection.turn(1));
        on("back_to_valid", () => this.after(() => this.shape.back_to_valid()));
        on("save_section", () => this.files.save_section());
        on("save_picture", () => this.files.save_picture());
        element("file").onchange = (event) => {
            if (event.target.files.length > 0) this.files.open(event.target.files[0]);
            event.target.value = "";
        };
    }

    show_keys() {
        const { morph, judge, draw } = this.times;
        element("timing").textContent =
            `Last frame: ${brief(morph + judge + draw)} ms (morph ${brief(morph)}, judge ${brief(judge)}, ` +
            `draw ${brief(draw)}). harmorph ${this.data.version}.`;
        element("keys").showModal();
    }

    // Returns the sections: the outlines whose wall points close a chain.
    find_sections() {
        const { data, model, wall } = this;
        if (model.curves === null) return [];
        const of_point = model.curve_points();
        return wall.chains.flatMap((chain) => {
            const { curve } = of_point.get(chain.points[0]) ?? {},
                outline = model.outlines.find(([first, n]) => curve >= first && curve < first + n);
            if (!chain.closed || outline === undefined) return [];
            return [new Section({ chain, outline, name: data.markers[chain.marker].name, model })];
        });
    }

    // ---- Changes of the shape

    // The shape has changed; the mesh follows with the next frame.
    changed() {
        this.moves = this.shape.moves();
        this.said_hello();
        this.must_follow = true;
        this.draw_soon();
    }

    // A change is finished, and undo takes it back.
    commit() {
        if (!this.shape.commit()) return;
        if (this.must_follow) this.follow();
        this.panel.update();
        this.panel.speak_verdict();
    }

    // Does something that ends with a finished change.
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

    // Puts the mesh where the movements put it, and judges the mesh.
    follow() {
        const begin = performance.now();
        this.must_follow = false;
        this.reached = "";
        this.displaced = false;
        this.still = this.moves.every((move) => move === 0);
        this.curves.move(this.moves);
        this.model.move(this.moves);
        const morphed = performance.now();
        this.judge();
        if (this.is_valid()) this.shape.remember_valid();
        Object.assign(this.times, { morph: morphed - begin, judge: performance.now() - morphed });
        this.panel.update();
    }
    judge() {
        const found = this.model.assess();
        this.cells.judge(found);
        this.wall.judge(found);
        for (const section of this.sections) section.judge(this.curves.now);
    }

    // Shows a mesh that was not reached by the functions alone; reached says how it was reached.
    show_reached(reached, displaced = false) {
        Object.assign(this, { reached, displaced });
        this.judge();
        this.panel.update();
        this.panel.speak_verdict();
        this.draw_soon();
    }

    is_valid() {
        return this.cells.inverted === 0 && this.wall.crossing.length === 0;
    }

    // Returns the fraction of the movement up to which no cell is inverted and the wall does not touch itself.
    admissible_step() {
        return Math.min(this.cells.step, this.wall.touch.step);
    }

    said_hello() {
        element("hint").classList.add("gone");
    }

    // ---- Drawing

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

    // Draws at once, or the browser would stretch the old picture for a moment.
    resize() {
        this.view.resize();
        this.draw();
    }

    set(options) {
        Object.assign(this.options, options);
        if (this.options.colour === "function")
            this.picture.set_values(this.model.size_of_function(this.selection.shown_function()));
        this.panel.update();
        this.draw_soon();
    }
    toggle(name) {
        this.set({ [name]: !this.options[name] });
        element(name).setAttribute("aria-pressed", this.options[name]);
    }
    set_theme(theme) {
        this.options.theme = theme;
        document.documentElement.classList.toggle("dark", theme === "dark");
    }
    switch_theme() {
        this.set_theme(this.options.theme === "dark" ? "light" : "dark");
        this.set({});
    }
}

function theme_of_system() {
    return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}
