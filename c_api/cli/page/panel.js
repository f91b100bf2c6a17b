"use strict";
// The panel: verdict, histogram, section, fields and sliders; and what screen readers are told.

const element = (id) => document.getElementById(id);

class Panel {
    constructor(app) {
        this.app = app;
        element("name").textContent = element("name").title = `${app.data.mesh} · ${app.data.operator}`;
        element("section_box").hidden = app.sections.length === 0;
        element("point_box").hidden = app.data.n_control + app.data.bodies.length === 0;
        element("pair").hidden = !app.pairs.partner.some((partner) => partner >= 0);
        this.choose("colour", app.options.colour, (value) => app.set({ colour: value }));
        this.choose("pair", app.options.pair, (value) => app.set({ pair: value }));
        this.fields();
        this.sliders = [];
        app.sections.forEach((section, place) => this.add_section(section, place));
        app.data.bodies.forEach((body, place) => this.add_body(body, place));
        element("sliders").hidden = this.sliders.length === 0;
    }

    // A row of buttons of which one is chosen: one stop for the Tab key, arrow keys choose.
    choose(id, value, then) {
        const buttons = [...element(id).children];
        const mark = (chosen) => {
            for (const button of buttons) {
                button.setAttribute("aria-checked", button === chosen);
                button.tabIndex = button === chosen ? 0 : -1;
            }
        };
        buttons.forEach((button, place) => {
            button.setAttribute("role", "radio");
            button.onclick = () => {
                mark(button);
                then(button.dataset.value);
            };
            button.onkeydown = (event) => {
                const by = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
                if (by === undefined) return;
                event.preventDefault();
                const next = buttons[(place + by + buttons.length) % buttons.length];
                next.focus();
                next.click();
            };
        });
        mark(buttons.find((button) => button.dataset.value === value));
    }

    // What is typed counts when it is a number, and is committed when the field is left.
    number_field(input, then) {
        const mark = (wrong) => {
            input.classList.toggle("wrong", wrong);
            input.setAttribute("aria-invalid", wrong);
        };
        input.oninput = () => {
            const value = number_of(input.value);
            mark(Number.isNaN(value));
            if (!Number.isNaN(value)) then(value);
        };
        input.onchange = () => {
            mark(false);
            this.app.commit();
            this.update();
        };
    }

    // The number that is not typed keeps all its digits.
    fields() {
        const { app } = this;
        this.number_field(element("dx"), (dx) => app.move_chosen(dx, app.chosen_movement()[1]));
        this.number_field(element("dy"), (dy) => app.move_chosen(app.chosen_movement()[0], dy));
    }

    // For screen readers, once something is finished: while it goes on they would not come to an end.
    speak(text) {
        element("spoken").textContent = text;
    }
    speak_verdict() {
        this.speak(`${element("verdict_word").textContent}. ${element("verdict_detail").textContent}`);
    }
    speak_choice() {
        const [dx, dy] = this.app.chosen_movement();
        this.speak(`${element("point_name").textContent}, moved by ${brief(dx)}, ${brief(dy)}`);
    }

    add_title(text) {
        const title = document.createElement("h2");
        title.textContent = text;
        element("sliders").append(title);
    }

    // owner: whose value it is; read and write: of the value in the shape.
    add_slider(owner, label, unit, low, high, step, read, write) {
        const row = document.createElement("div"),
            range = document.createElement("input"),
            field = document.createElement("input");
        const name = document.createElement("span"),
            small = document.createElement("small");
        row.className = "slider";
        name.textContent = label + " ";
        small.textContent = unit;
        name.append(small);
        Object.assign(range, { type: "range", min: low, max: high, step });
        field.inputMode = "decimal";
        range.setAttribute("aria-label", `${label} ${unit}, ${owner}`);
        field.setAttribute("aria-label", `${label} ${unit} as a number, ${owner}`);
        range.oninput = () => {
            write(Number(range.value));
            this.app.changed();
        };
        range.onchange = () => this.app.commit();
        range.ondblclick = () => {
            write(low > 0 ? 1 : 0);
            this.app.changed();
            this.app.commit();
        };
        this.number_field(field, (value) => {
            write(value);
            this.app.changed();
        });
        row.append(name, range, field);
        element("sliders").append(row);
        this.sliders.push({ range, field, read });
    }

    add_section(section, place) {
        if (section.control.length === 0) return;
        if (this.app.sections.length + this.app.data.bodies.length > 1) this.add_title(section.name);
        const values = () => this.app.shape.state.variables[place];
        for (const { name, label, unit, most, step } of Section.variables) {
            this.add_slider(
                section.name,
                label,
                unit,
                -most,
                most,
                step,
                () => values()[name],
                (value) => {
                    values()[name] = value;
                },
            );
        }
    }

    add_body(body, place) {
        this.add_title(body.marker);
        const extent = this.app.extent,
            digits = 10 ** Math.floor(Math.log10(extent / 100));
        const values = () => this.app.shape.state.bodies[place];
        const add = (name, label, unit, low, high, step) =>
            this.add_slider(
                body.marker,
                label,
                unit,
                low,
                high,
                step,
                () => values()[name],
                (value) => {
                    values()[name] = value;
                },
            );
        add("x", "Move x", "", -extent, extent, digits);
        add("y", "Move y", "", -extent, extent, digits);
        add("degrees", "Turn", "°", -90, 90, 0.5);
        add("scale", "Scale", "", 0.5, 2, 0.01);
    }

    update() {
        this.update_verdict();
        this.update_colours();
        this.update_section();
        this.update_fields();
        const { done, undone } = this.app.shape;
        element("undo").disabled = done.length === 0;
        element("redo").disabled = undone.length === 0;
    }

    update_verdict() {
        const { app } = this,
            { cells, wall, still } = app,
            { inverted } = cells,
            { touch } = wall,
            step = app.admissible_step(),
            crosses = wall.crossing.length > 0,
            percent = short(Math.min(1, step) * 100);
        const words =
            inverted > 0
                ? `${inverted} inverted ${inverted === 1 ? "cell" : "cells"}`
                : crosses
                  ? "Wall crosses itself"
                  : cells.n < app.data.all_cells
                    ? "Valid near the body"
                    : "Valid mesh";
        element("verdict_word").textContent = words;
        element("verdict_detail").textContent =
            inverted > 0 || crosses
                ? `${percent} % of this movement is possible${inverted > 0 && crosses ? "; the wall crosses itself" : ""}`
                : still
                  ? "Nothing has moved yet"
                  : touch.point >= 0 && step < 2
                    ? "The wall touches itself before a cell inverts"
                    : `quality ${short(cells.min_quality)} at least, ${short(cells.mean_quality)} mean`;
        element("back_to_valid").hidden = app.is_valid();
        const used = step === Infinity ? 0 : Math.min(1, 1 / step);
        element("verdict").className =
            "verdict " + (inverted > 0 || crosses ? "bad" : used > 0.5 ? "warn good" : "good");
        element("gauge_fill").style.width = `${100 * used}%`;
        element("gauge").setAttribute("aria-valuenow", Math.round(100 * used));
        element("step").textContent = still ? "–" : step === Infinity ? "unlimited" : `${short(step)} × this movement`;
    }

    update_section() {
        const { app } = this,
            section = app.current_section();
        if (!section) return;
        element("section_name").textContent = section.name;
        element("section_name").hidden = app.sections.length === 1;
        const { start, now } = section,
            rows = [
                [`Thickness at ${(100 * now.thickest).toFixed(0)} %`, now.thickness * 100, start.thickness * 100, "%"],
                ["Camber", now.camber * 100, start.camber * 100, "%"],
                ["Chord", now.chord, start.chord, ""],
                ["Twist", now.twist, start.twist, "°"],
                ["Area", now.area, start.area, ""],
            ];
        if (now.nose_radius) rows.push(["Leading-edge radius", now.nose_radius, start.nose_radius, ""]);
        if (now.edge_angle) rows.push(["Trailing-edge angle", now.edge_angle, start.edge_angle, "°"]);
        const body = element("section").tBodies[0];
        while (body.rows.length < rows.length) {
            const row = body.insertRow(),
                name = document.createElement("th");
            name.scope = "row";
            row.append(name);
            for (let i = 0; i < 2; ++i) row.insertCell();
        }
        while (body.rows.length > rows.length) body.deleteRow(-1);
        rows.forEach(([name, value, before, unit], i) => {
            const cells = body.rows[i].cells,
                change = value - before,
                digits = unit === "" ? 4 : 2;
            const shown = Math.abs(change) >= 0.5 * 10 ** -digits;
            cells[0].textContent = name;
            cells[1].textContent = `${fixed(value, digits)}${unit === "°" ? "" : " "}${unit}`;
            cells[2].textContent = shown ? (change > 0 ? "+" : "") + fixed(change, digits) : "";
            cells[2].className = shown ? "changed" : "";
        });
    }

    update_fields() {
        const { app } = this,
            has_choice = app.selected >= 0 || app.chosen_body >= 0,
            movement = app.chosen_movement();
        const show = (input, value) => {
            if (document.activeElement !== input) input.value = value;
        };
        element("point_name").textContent = app.name_of_choice();
        ["dx", "dy"].forEach((id, axis) => {
            element(id).disabled = !has_choice;
            show(element(id), has_choice ? tidy(movement[axis]) : "");
        });
        for (const { range, field, read } of this.sliders) {
            if (document.activeElement !== range) range.value = read();
            show(field, tidy(read()));
        }
    }

    update_colours() {
        const { app } = this,
            { colour } = app.options;
        element("histogram_box").hidden = colour === "none";
        if (colour === "none") return;
        const shown = app.legend.distribution();
        for (const end of ["low", "high"]) element("scale_" + end).textContent = shown[end + "_text"];
        element("scale_name").textContent = shown.name;
        element("colour_summary").textContent = shown.summary;
        this.draw_histogram(shown);
    }

    // values: from low to high; the bars have the colours of the picture.
    draw_histogram({ values, low, high, colour_at }) {
        const canvas = element("histogram"),
            ratio = devicePixelRatio,
            width = canvas.clientWidth,
            height = canvas.clientHeight;
        canvas.width = width * ratio;
        canvas.height = height * ratio;
        const context = canvas.getContext("2d"),
            n = 40,
            counts = new Array(n).fill(0),
            strip = 8;
        context.scale(ratio, ratio);
        for (const value of values) {
            const bin = Math.floor(((value - low) / (high - low)) * n);
            ++counts[Math.min(Math.max(bin, 0), n - 1)];
        }
        const most = Math.max(1, ...counts),
            tall = height - strip - 4;
        counts.forEach((count, bin) => {
            const left = (bin * width) / n,
                up = count === 0 ? 0 : Math.max(2, tall * Math.sqrt(count / most));
            context.fillStyle = style_of("--quiet");
            context.fillRect(left + 0.5, tall - up, width / n - 1, up);
            context.fillStyle = colour_at(low + ((bin + 0.5) / n) * (high - low));
            context.fillRect(left, height - strip, width / n + 0.5, strip);
        });
    }
}
