"use strict";
// The controls of the panel: rows of buttons, fields of numbers, and sliders of design variables and rigid bodies.

class Controls {
    constructor(app) {
        this.app = app;
        element("point_box").hidden = app.data.n_control + app.data.bodies.length === 0;
        element("pair").hidden = !app.pairs.partner.some((partner) => partner >= 0);
        this.choose("colour", app.options.colour, (value) => app.set({ colour: value }));
        this.choose("pair", app.options.pair, (value) => app.set({ pair: value }));
        // The number that is not typed keeps all its digits.
        this.number_field(element("dx"), (dx) => app.movement.move_choice(dx, app.movement.of_choice()[1], "dx"));
        this.number_field(element("dy"), (dy) => app.movement.move_choice(app.movement.of_choice()[0], dy, "dy"));
        this.sliders = [];
        app.sections.forEach((section, place) => this.add_section(section, place));
        app.data.bodies.forEach((body, place) => this.add_body(body, place));
        element("sliders").hidden = this.sliders.length === 0;
    }

    // Makes a row of buttons of which one is chosen. The Tab key stops once in the row; arrow keys choose.
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

    // A typed text counts when it is a number; the change is finished when the user leaves the field.
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
            this.app.panel.update();
        };
    }

    add_title(text) {
        const title = document.createElement("h2");
        title.textContent = text;
        element("sliders").append(title);
    }

    // Adds a slider for one number, values[name], of a section or body; values() returns the present ones in the shape.
    // A double click sets the number that means no movement.
    add_slider(values, { owner, name, label, unit, low, high, step, rest = 0 }) {
        const row = document.createElement("div"),
            range = document.createElement("input"),
            field = document.createElement("input");
        const title = document.createElement("span"),
            small = document.createElement("small");
        const read = () => values()[name],
            write = (value) =>
                this.app.movement.change(row, () => {
                    values()[name] = value;
                });
        row.className = "slider";
        title.textContent = label + " ";
        small.textContent = unit;
        title.append(small);
        Object.assign(range, { type: "range", min: low, max: high, step });
        field.inputMode = "decimal";
        range.setAttribute("aria-label", `${label} ${unit}, ${owner}`);
        field.setAttribute("aria-label", `${label} ${unit} as a number, ${owner}`);
        range.oninput = () => write(Number(range.value));
        range.onchange = () => this.app.commit();
        range.ondblclick = () => {
            write(rest);
            this.app.commit();
        };
        this.number_field(field, write);
        row.append(title, range, field);
        element("sliders").append(row);
        this.sliders.push({ range, field, read });
    }

    add_section(section, place) {
        if (section.control.length === 0) return;
        if (this.app.sections.length + this.app.data.bodies.length > 1) this.add_title(section.name);
        const values = () => this.app.shape.state.variables[place];
        for (const { most, ...variable } of section.variables)
            this.add_slider(values, { owner: section.name, low: -most, high: most, ...variable });
    }

    add_body({ marker: owner }, place) {
        this.add_title(owner);
        const { extent } = this.app.view,
            step = 10 ** Math.floor(Math.log10(extent / 100)),
            values = () => this.app.shape.state.bodies[place];
        for (const number of [
            { name: "x", label: "Move x", unit: "", low: -extent, high: extent, step },
            { name: "y", label: "Move y", unit: "", low: -extent, high: extent, step },
            { name: "degrees", label: "Turn", unit: "°", low: -90, high: 90, step: 0.5 },
            { name: "scale", label: "Scale", unit: "", low: 0.5, high: 2, step: 0.01, rest: 1 },
        ])
            this.add_slider(values, { owner, ...number });
    }

    update() {
        const { selection, movement, shape } = this.app,
            numbers = movement.of_choice();
        const show = (input, value) => {
            if (document.activeElement !== input) input.value = value;
        };
        element("point_name").textContent = selection.name();
        ["dx", "dy"].forEach((id, axis) => {
            element(id).disabled = selection.is_empty();
            show(element(id), selection.is_empty() ? "" : tidy(numbers[axis]));
        });
        for (const { range, field, read } of this.sliders) {
            if (document.activeElement !== range) range.value = read();
            show(field, tidy(read()));
        }
        element("undo").disabled = shape.done.length === 0;
        element("redo").disabled = shape.undone.length === 0;
    }
}
