"use strict";
// Morphs by the program, and saves files.

// The file that morph writes has the name of the mesh with -morphed in it; in a case of OpenFOAM it is the time 1.
function morphed_path(files, mesh) {
    if (!files.has(mesh)) return mesh === "." ? "1" : `${mesh}/1`;
    const name = mesh.split("/").pop(),
        [, stem, end] = /^(.+?)((?:\.[^.]*){0,2})$/.exec(name);
    return free_path(files, `${stem}-morphed${end}`);
}

class Morph {
    constructor(bench) {
        this.bench = bench;
        this.how = "moves";
        this.tables = { airfoil: null, table: null };
        element("morph").onclick = () => bench.attempt("morph", () => this.run());
        choices(element("how"), (value) => this.choose(value));
        choices(element("shown"), (value) => this.show_result(value));
        element("line_add").onclick = () => this.add_line();
        element("line_kind").onchange = () => this.name_fields();
        element("line_value").onkeydown = (event) => event.key === "Enter" && this.add_line();
        for (const [id, kind] of [["open_airfoil", "airfoil"], ["open_table", "table"], ["open_moves", "moves"]])
            element(id).onclick = () => bench.ask_file((file) => this.take(kind, file));
        element("save_curve").onclick = () => bench.attempt("curve", () => this.save_curve());
        this.name_fields();
    }

    forget() {
        this.result = null;
        element("moves").value = "";
        element("result_box").hidden = true;
        element("line_of").replaceChildren(...this.bench.boundary.sections().map((place) => new Option(place, place)));
        element("save_curve").disabled = this.bench.prepare.curves.length === 0;
        for (const control of element("how").children)
            control.disabled = control.dataset.value !== "table" && this.bench.basis === null;
        this.choose(this.bench.basis === null ? "table" : "moves");
    }
    // Takes the movements of the page.
    async enter() {
        const told = await this.bench.drag.ask();
        if (told?.displaced)
            this.bench.view.say("Displacements of wall points are no movement; choose their table instead.");
        if (told === null || told.displaced || told.moves === this.told) return;
        this.told = told.moves;
        element("moves").value = told.moves;
        element("safe").checked = !told.valid || told.reached !== "";
    }

    choose(how) {
        this.how = how;
        set_choice(element("how"), how);
        for (const one of ["moves", "airfoil", "table"]) element(`how_${one}`).hidden = one !== how;
    }
    // Takes a file that the user has opened or dropped.
    async take(kind, [path, file]) {
        const { files } = this.bench;
        if (kind === "moves") {
            element("moves").value = await file.text();
        } else {
            const free = free_path(files, path.split("/").pop());
            files.set(free, file);
            this.bench.inputs.set(free, file);
            this.tables[kind] = free;
            element(`${kind}_name`).textContent = free;
        }
        this.choose(kind);
    }

    name_fields() {
        const kind = element("line_kind").value,
            names = { turn: "degrees", flap: "degrees", shift: "dx dy", scale: "factor" };
        element("line_value_name").textContent = names[kind];
        element("line_value").value = { turn: "3", flap: "5", shift: "0 0.1", scale: "1.1" }[kind];
        element("line_hinge_box").hidden = kind === "shift";
        element("line_at").placeholder = kind === "flap" ? "0.75,0" : "quarter chord";
    }
    add_line() {
        const [kind, of, value] = ["line_kind", "line_of", "line_value"].map((id) => element(id).value.trim()),
            hinge = element("line_at").value.trim().replace(/\s+/g, ","),
            at = hinge === "" && kind === "flap" ? element("line_at").placeholder : hinge,
            words = { shift: [of, value], flap: [of, at, value] }[kind] ?? [of, value, at],
            text = element("moves").value.trimEnd();
        element("moves").value = `${text}${text === "" ? "" : "\n"}${[kind, ...words].join(" ").trimEnd()}\n`;
    }

    // Returns the words of the command that is chosen.
    words(out, picture, report) {
        const { bench } = this,
            words = [];
        if (this.how === "table") {
            const { boundary } = bench,
                walls = boundary.groups("curve").flat(),
                operator = element("operator").value;
            if (walls.length === 0) throw new Error("Choose a wall that follows a curve: its points are displaced.");
            words.push("displace", operand(bench.mesh), "--given", Boundary.places(walls));
            words.push("--wall", operand(this.tables.table), ...boundary.beside());
            if (operator !== "conformal") words.push("--operator", operator);
        } else {
            words.push("morph", operand(bench.mesh), bench.basis);
            if (this.how === "moves") words.push("--move", this.moves_path);
            else words.push("--to-airfoil", operand(this.tables.airfoil));
            if (this.how === "airfoil" && element("on_chord").checked) words.push("--on-chord");
            words.push("--svg", picture);
        }
        if (element("safe").checked || element("heights").checked) words.push("--safe");
        if (element("heights").checked) words.push("--heights");
        words.push(...words_of(element("more_morph").value), "--kernel", "baseline");
        return words.concat("-o", out, "--report", report, "--json");
    }

    async run() {
        const { bench } = this,
            [picture, report] = ["morph.svg", "report.html"].map((path) => free_path(bench.inputs, path)),
            out = morphed_path(bench.inputs, bench.mesh);
        if (this.how !== "moves" && this.tables[this.how] === null)
            throw new Error(`Open ${this.how === "table" ? "a table of displacements" : "an airfoil file"} first.`);
        this.moves_path = free_path(bench.inputs, "moves.txt");
        const moves = element("moves").value;
        if (this.how === "moves")
            bench.files.set(this.moves_path, new Blob([moves.trim() === "" ? "# none\n" : moves]));
        for (const path of [picture, report, out, `${out}.curve`]) bench.files.delete(path);
        this.result = { picture, report, out };
        let result;
        try {
            result = await bench.program.run("Morphing", this.words(out, picture, report), bench.files);
        } catch (error) {
            if (error instanceof Refused) this.show(error.result);
            throw error;
        }
        this.show(result);
    }

    // Shows what the program said of the moved mesh; there may be no mesh, but a report.
    show(result) {
        const { bench } = this,
            done = result.code === 0,
            facts = result.said.trim() === "" ? null : JSON.parse(result.said),
            has_picture = bench.files.has(this.result.picture);
        bench.show_files();
        element("result_box").hidden = facts === null;
        if (facts === null) return;
        element("verdict").textContent = done ? "The moved mesh is valid." : "The moved mesh cannot be used.";
        element("verdict").className = done ? "good" : "bad";
        const { inverted, min_quality, step_fraction, admissible_step, airfoil_max_error } = facts,
            rows = [["Inverted cells", String(inverted)], ["Smallest quality", brief(min_quality)]];
        if (step_fraction !== undefined) rows.push(["Part that was reached", `${brief(100 * step_fraction)} %`]);
        else rows.push(["Admissible step", admissible_step === null ? "any" : `${brief(admissible_step)} times this`]);
        if (airfoil_max_error !== undefined) rows.push(["Farthest from the airfoil", brief(airfoil_max_error)]);
        show_facts(element("verdict_facts"), rows);
        show_lines(element("morph_result"), warnings_of(result));
        element("shown").hidden = !(has_picture && bench.files.has(this.result.report));
        if (has_picture)
            bench.view.show_picture(bench.files.get(this.result.picture), "The mesh before in blue and after in red");
        this.show_result(has_picture ? "picture" : "report");
        element("result_box").scrollIntoView({ block: "nearest" });
        bench.view.speak(element("verdict").textContent);
    }
    async show_result(what) {
        const { bench } = this;
        set_choice(element("shown"), what);
        if (what === "picture") return bench.view.show("view");
        if (!bench.files.has(this.result.report)) return undefined;
        bench.view.show_page(await bench.files.get(this.result.report).text(), "Report of the morph", "report_box");
        return undefined;
    }

    // Saves the moved curve, or the fitted one, in the format that is chosen.
    async save_curve() {
        const { bench } = this,
            moved = this.result === null ? "" : `${this.result.out}.curve`,
            [from] = bench.files.has(moved) ? [moved] : bench.prepare.curves,
            to = free_path(bench.inputs, `${from.replace(/\.curve$/, "")}${element("curve_format").value}`);
        if (to !== from) await bench.program.run("Writing the curve", ["curve", from, "-o", to], bench.files);
        bench.show_files();
        save_file(to, bench.files.get(to));
    }
}

// Makes buttons in a row a choice of one; arrow keys choose the next one.
function choices(row, chosen) {
    const buttons = [...row.children];
    buttons.forEach((button, place) => {
        button.onclick = () => chosen(button.dataset.value);
        button.onkeydown = ({ key }) => {
            const by = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[key];
            if (by === undefined) return;
            const next = buttons[(place + by + buttons.length) % buttons.length];
            next.focus();
            next.click();
        };
    });
}
function set_choice(row, value) {
    for (const button of row.children) {
        const is_chosen = button.dataset.value === value;
        button.setAttribute("aria-checked", is_chosen);
        button.tabIndex = is_chosen ? 0 : -1;
    }
}
