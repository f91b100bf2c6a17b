"use strict";
// In a frame, as that of the workbench, the page tells the page around it what has moved, when it is asked.

window.addEventListener("message", ({ source, data }) => {
    if (source !== window.parent || source === window || app === null || data?.harmorph !== "tell") return;
    const moves = app.shape.text() + app.panel.design.states.text();
    source.postMessage({ harmorph: "moves", moves, reached: app.reached, valid: app.is_valid() }, "*");
});
