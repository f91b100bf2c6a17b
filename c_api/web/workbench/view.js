"use strict";
// The stage: a picture to zoom, a page in a frame, the bar of progress, and messages.

// Files that are dropped on a page in a frame go to the workbench, but for those that the page of control points takes.
const FORWARD_DROPS = `<script>
addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
    const files = [...event.dataTransfer.files];
    if (document.getElementById("handles") && files.length === 1 && /\\.(dat|txt)$/i.test(files[0].name)) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    parent.postMessage({ harmorph: "files", files }, "*");
}, true);
<\/script>`;

class View {
    // settle() is called when a message appears or goes.
    constructor(settle) {
        this.settle = settle;
        this.box = element("picture_box");
        this.image = element("picture");
        this.scale = 1;
        element("zoom_fit").onclick = () => this.zoom_to(1);
        element("zoom_in").onclick = () => this.zoom_to(this.scale * 1.5);
        element("zoom_out").onclick = () => this.zoom_to(this.scale / 1.5);
        this.box.onkeydown = (event) => {
            const factor = { "+": 1.5, "=": 1.5, "-": 1 / 1.5 }[event.key];
            if (factor !== undefined) this.zoom_to(this.scale * factor);
            if (event.key === "0") this.zoom_to(1);
        };
        this.box.addEventListener("wheel", (event) => {
            event.preventDefault();
            this.zoom_to(this.scale * Math.exp(-event.deltaY / 400), event.clientX, event.clientY);
        }, { passive: false });
        this.pan();
    }
    // A mouse drags the picture; fingers scroll by themselves.
    pan() {
        let last = null;
        this.box.onpointerdown = (event) => {
            if (event.pointerType !== "mouse" || event.button !== 0) return;
            last = event;
            this.box.setPointerCapture(event.pointerId);
            event.preventDefault();
            this.box.focus({ preventScroll: true });
        };
        this.box.onpointermove = (event) => {
            if (last === null) return;
            this.box.scrollBy(last.clientX - event.clientX, last.clientY - event.clientY);
            last = event;
        };
        this.box.onpointerup = this.box.onpointercancel = () => (last = null);
    }

    // Zooms; the place under (x, y) of the window stays where it is.
    zoom_to(scale, x, y) {
        const frame = this.box.getBoundingClientRect(),
            px = x === undefined ? frame.width / 2 : x - frame.left,
            py = y === undefined ? frame.height / 2 : y - frame.top,
            before = this.scale;
        this.scale = Math.min(Math.max(scale, 1), 40);
        const factor = this.scale / before,
            [left, top] = [(this.box.scrollLeft + px) * factor - px, (this.box.scrollTop + py) * factor - py];
        this.image.style.width = this.image.style.height = `${100 * this.scale}%`;
        this.box.scrollTo(left, top);
    }

    // Shows a picture, which is an image: no script in it runs.
    show_picture(blob, text) {
        if (this.shown !== undefined) URL.revokeObjectURL(this.shown);
        this.shown = URL.createObjectURL(new Blob([blob], { type: "image/svg+xml" }));
        this.image.src = this.shown;
        this.image.alt = text;
        this.has_picture = true;
        this.zoom_to(1);
    }
    // what: "welcome", "view" (the picture), "page_box", or "report_box".
    show(what) {
        for (const id of ["welcome", "view", "page_box", "report_box"]) element(id).hidden = id !== what;
    }

    // Shows a page that the program has written, which can reach nothing outside its frame.
    show_page(text, title, box) {
        const frame = document.createElement("iframe");
        frame.setAttribute("sandbox", "allow-scripts allow-downloads allow-forms");
        frame.title = title;
        frame.srcdoc = text + FORWARD_DROPS;
        element(box).replaceChildren(frame);
        this.show(box);
        return frame;
    }

    progress(what, fraction) {
        element("work").hidden = what === "";
        if (what === "") return;
        element("work_what").textContent = what;
        if (fraction < 0) element("work_bar").removeAttribute("value");
        else element("work_bar").value = fraction;
    }

    // title: of an error; "" for a note.
    say(text, title = "") {
        element("message_title").textContent = title;
        element("message_text").textContent = text;
        element("message").classList.toggle("error", title !== "");
        element("message").hidden = text === "";
        this.settle();
    }
    speak(text) {
        element("spoken").textContent = text;
    }
}

// Fills a list with texts.
function show_lines(list, lines) {
    list.replaceChildren(...lines.map((line) => {
        const item = document.createElement("li");
        item.textContent = line;
        return item;
    }));
}

// Fills a list of names and values.
function show_facts(list, facts) {
    list.replaceChildren(...facts.flatMap(([name, value]) => {
        const [term, text] = [document.createElement("dt"), document.createElement("dd")];
        term.textContent = name;
        text.textContent = value;
        return [term, text];
    }));
}
const plural = (n, word) => `${n.toLocaleString("en")} ${word}${n === 1 ? "" : "s"}`;
const brief = (number) => (number === null ? "any" : String(Number(Number(number).toPrecision(4))));
const warnings_of = (result) => result.lines.filter(is_warning).map(plain);
