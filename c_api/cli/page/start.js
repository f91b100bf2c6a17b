"use strict";
// Begins with the page: the module is instantiated, then the application is made.

async function load_classes() {
    const compressed = Uint8Array.from(atob(page_module), (character) => character.charCodeAt(0)),
        stream = new Blob([compressed]).stream().pipeThrough(new DecompressionStream("gzip")),
        { instance } = await WebAssembly.instantiate(await new Response(stream).arrayBuffer());
    return harmorph.bound.bind(instance, "simd128", () => {});
}

function say_at_start(text) {
    Object.assign(element("message"), { textContent: text, hidden: text === "" });
}

let app = null;
const page_started = (async () => {
    say_at_start("Computing the functions of the mesh …");
    const classes = await load_classes();
    await new Promise((then) => setTimeout(then, 0)); // the browser shows the message meanwhile
    app = new App(page_data, classes);
    element("hint").classList.remove("gone");
    if (window.parent !== window) window.parent.postMessage({ harmorph: "ready" }, "*");
    say_at_start("");
})().catch((error) => {
    const is_old = typeof DecompressionStream === "undefined" || error instanceof WebAssembly.CompileError;
    say_at_start(is_old ? "This page needs a browser of 2023 or newer." : `This page cannot compute: ${error.message}`);
    throw error;
});
