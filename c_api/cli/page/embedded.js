"use strict";
// In a frame, as that of the workbench, the page tells the page around it what has moved, when it is asked, and is as
// light or dark.

document.documentElement.classList.toggle("framed", window.parent !== window);
window.addEventListener("message", ({ source, data }) => {
    if (source !== window.parent || source === window || app === null) return;
    if (data?.harmorph === "tell") {
        const moves = app.shape.text() + app.panel.design.states.text(),
            { reached, displaced } = app;
        source.postMessage({ harmorph: "moves", moves, reached, displaced, valid: app.is_valid() }, "*");
    }
    if (data?.harmorph === "theme") {
        app.set_theme(data.dark === true ? "dark" : "light");
        app.set({});
    }
});
