"use strict";
// The page of `harmorph explore` in a frame: control points are dragged on it.

class Drag {
    constructor(bench) {
        this.bench = bench;
        this.frame = null;
        this.asked = null; // takes the next answer of the page
        window.addEventListener("message", (event) => this.hear(event));
    }

    // Makes the page of the present basis.
    async open() {
        const { bench } = this,
            page = free_path(bench.inputs, "page.html");
        this.close();
        const words = ["explore", operand(bench.mesh), bench.basis, "--points", "100000000", "-o", page];
        await bench.program.run("Making the page", words, bench.files);
        this.page = bench.files.get(page);
        bench.show_files();
        bench.update_tabs();
        await bench.show_tab("drag");
    }
    close() {
        this.page = null;
        this.is_ready = false;
        this.frame = null;
        element("page_box").replaceChildren();
    }
    async show() {
        if (this.frame === null || !this.frame.isConnected) {
            const title = "The mesh with its control points, which can be dragged";
            this.frame = this.bench.view.show_page(await this.page.text(), title, "page_box");
        }
        this.bench.view.show("page_box");
    }

    set_theme() {
        const dark = document.documentElement.classList.contains("dark");
        this.frame?.contentWindow?.postMessage({ harmorph: "theme", dark }, "*");
    }

    // Asks the page what has moved; returns { moves, reached, displaced, valid }, or null where there is no page, or
    // one that is not ready.
    ask() {
        if (this.frame === null || !this.is_ready) return Promise.resolve(null);
        return new Promise((done) => {
            this.asked = done;
            this.frame.contentWindow.postMessage({ harmorph: "tell" }, "*");
            setTimeout(() => done(null), 5000);
        });
    }
    hear({ source, data }) {
        if (this.frame === null || source !== this.frame.contentWindow) return;
        if (data?.harmorph === "ready") {
            this.is_ready = true;
            this.set_theme();
        }
        if (data?.harmorph === "moves" && typeof data.moves === "string" && this.asked !== null) {
            const answer = this.asked;
            this.asked = null;
            const [displaced, valid] = [data.displaced === true, data.valid === true];
            answer({ moves: data.moves, reached: String(data.reached), displaced, valid });
        }
    }
}
