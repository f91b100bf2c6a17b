"use strict";
// The workbench: its files, its tabs, and what is dropped on it.

const TABS = ["prepare", "drag", "save"];

class Bench {
    constructor() {
        this.view = new View(() => this.update_panel());
        this.program = new Program((what, fraction) => this.view.progress(what, fraction));
        this.files = new Map(); // path: Blob, of what was opened and of what the program made
        this.inputs = new Map(); // those that were opened
        this.mesh = null;
        this.basis = null;
        this.boundary = null;
        this.tab = "prepare";
        this.prepare = new Prepare(this);
        this.drag = new Drag(this);
        this.morph = new Morph(this);
        this.connect_buttons();
        this.connect_drops();
        this.update_panel();
        this.set_theme(matchMedia("(prefers-color-scheme: dark)").matches);
        this.program.ready.catch((error) => this.view.say(error.message, "The workbench cannot compute"));
    }

    connect_buttons() {
        const on = (id, action) => (element(id).onclick = action);
        on("open", () => element("file_mesh").click());
        on("open_folder", () => element("file_folder").click());
        on("again", () => element("file_mesh").click());
        on("example", () => this.attempt("check", async () => {
            await this.prepare.open([["naca0012.su2", await unpacked("example_mesh").blob()]]);
        }));
        on("cancel", () => this.program.cancel());
        on("message_close", () => this.view.say(""));
        on("theme", () => this.set_theme(!document.documentElement.classList.contains("dark")));
        on("help", () => element("about").showModal());
        for (const tab of TABS) on(`tab_${tab}`, () => this.attempt("", () => this.show_tab(tab)));
        for (const id of ["file_mesh", "file_folder"]) {
            element(id).onchange = ({ target }) => {
                const files = listed_files(target.files);
                target.value = "";
                if (files.length > 0) this.attempt("check", () => this.prepare.open(files));
            };
        }
    }
    // Lets the user choose one file; then calls taken([path, File]).
    ask_file(taken) {
        const input = element("file_other");
        input.onchange = () => {
            const [file] = listed_files(input.files);
            input.value = "";
            if (file) this.attempt("", () => taken(file));
        };
        input.click();
    }

    connect_drops() {
        let depth = 0; // of the element under the pointer
        const hint = (by) => {
            depth = by === 0 ? 0 : depth + by;
            element("drop_hint").hidden = depth <= 0;
        };
        document.addEventListener("dragenter", () => hint(1));
        document.addEventListener("dragleave", () => hint(-1));
        document.addEventListener("dragover", (event) => event.preventDefault());
        window.addEventListener("message", (event) => this.hear(event));
        document.addEventListener("drop", (event) => {
            event.preventDefault();
            hint(0);
            const files = dropped_files(event.dataTransfer);
            this.attempt("check", async () => this.take(await files));
        });
    }
    // A frame forwards what is dropped on it.
    hear({ source, data }) {
        const is_frame = [...document.querySelectorAll("iframe")].some((frame) => frame.contentWindow === source);
        if (!is_frame || data?.harmorph !== "files" || !Array.isArray(data.files)) return;
        const files = listed_files(data.files.filter((file) => file instanceof File));
        this.attempt("check", () => this.take(files));
    }
    // Files are a mesh, or, beside a mesh, an airfoil, a table or moves.
    async take(files) {
        if (files.length === 0) return;
        const [[path, file]] = files,
            is_small = file.size < 1e8 && /\.(dat|txt|csv)$/i.test(path),
            is_beside = files.length === 1 && this.boundary !== null && is_small,
            kind = is_beside ? await kind_of(file, path) : "mesh";
        if (kind === "mesh") {
            await this.prepare.open(files);
        } else {
            if (this.basis === null && kind !== "table")
                throw new Error(`Fit and solve first; then drop ${path} again.`);
            await this.show_tab("save");
            await this.morph.take(kind, files[0]);
        }
    }

    // Does something, and shows why it cannot be done. name: of the command.
    async attempt(name, action) {
        this.view.say("");
        try {
            await action();
        } catch (error) {
            if (error instanceof Cancelled) return;
            const title = error instanceof Refused ? `harmorph ${name} refuses` : "This does not work";
            this.view.say(error.message, title);
            element("message").scrollIntoView({ block: "nearest" });
        } finally {
            this.show_commands();
        }
    }

    begin_mesh(files, mesh) {
        this.files = files;
        this.inputs = new Map(files);
        this.mesh = mesh;
        this.boundary = null;
        this.basis = null;
        this.program.commands = [];
        this.drag.close();
        for (const id of ["mesh_box", "boundary_box", "fit_box", "solve_box"]) element(id).hidden = true;
        element("mesh_name").textContent = mesh;
        this.view.show("welcome");
        this.update_tabs();
        this.show_tab("prepare");
    }
    close_mesh() {
        element("mesh_name").textContent = "";
    }

    update_tabs() {
        element("tab_drag").disabled = this.basis === null || this.drag.page === null;
        element("tab_save").disabled = this.boundary === null;
    }
    async show_tab(tab) {
        if (tab === "save") {
            if (this.morph.basis !== this.basis || this.morph.mesh !== this.mesh) this.morph.forget();
            Object.assign(this.morph, { basis: this.basis, mesh: this.mesh });
            await this.morph.enter();
        }
        this.tab = tab;
        for (const one of TABS) {
            if (one === tab) element(`tab_${one}`).setAttribute("aria-current", "step");
            else element(`tab_${one}`).removeAttribute("aria-current");
        }
        element("prepare").hidden = tab !== "prepare";
        element("save_panel").hidden = tab !== "save";
        if (tab === "drag") await this.drag.show();
        else if (this.boundary !== null) this.view.show("view");
        this.show_files();
        this.update_panel();
    }
    // Where there is nothing to set and nothing to say, the stage has the whole window.
    update_panel() {
        const is_empty = this.tab === "drag" || this.boundary === null;
        element("panel").hidden = is_empty && element("message").hidden;
        element("again_box").hidden = this.boundary === null;
    }

    // Lists the files that the program has made.
    show_files() {
        const made = [...this.files].filter(([path]) => !this.inputs.has(path));
        element("files").replaceChildren(...made.map(([path, blob]) => {
            const item = document.createElement("li"),
                button = document.createElement("button"),
                size = document.createElement("small");
            button.textContent = path;
            button.title = `Save ${path}`;
            button.onclick = () => save_file(path, blob);
            size.textContent = size_in_words(blob.size);
            item.append(button, size);
            return item;
        }));
    }
    show_commands() {
        const { commands } = this.program,
            line = (words) => typed(words.filter((word) => word !== "--json")).join(" ");
        element("commands_box").hidden = commands.length === 0;
        element("commands").textContent = commands.map(line).join("\n");
    }

    set_theme(is_dark) {
        document.documentElement.classList.toggle("dark", is_dark);
        this.drag.set_theme();
    }
}

// Returns what a file is that was dropped beside a mesh: two numbers in a line are an airfoil; three are moves or
// displacements of wall points, which begin at point 0 or have more lines than control points.
async function kind_of(file, path) {
    const text = await file.text(),
        words = (line) => line.replace(/#.*/, "").trim().split(/[\s,;]+/),
        rows = text.split("\n").map(words).filter(([first]) => first !== ""),
        numbers = rows.filter((row) => row.every((word) => Number.isFinite(Number(word))));
    if (/\.csv$/i.test(path) && rows.length > numbers.length) return "table";
    if (numbers.length > 3 && numbers[numbers.length - 1].length === 2) return "airfoil";
    const has_many = numbers.length > 300 || numbers.some(([point]) => point === "0");
    if (numbers.length > 0 && numbers[0].length === 3 && has_many) return "table";
    return /\.dat$/i.test(path) ? "airfoil" : "moves";
}

const bench = new Bench();
