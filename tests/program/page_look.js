"use strict";
// Checks the look of the page of `harmorph explore` in a window: on telephones, on large screens, in the reader's own
// colours. Leaves lines "check NAME ok" or "check NAME FAILED ..." as page.js does.
(() => {
    const lines = [];
    const check = (name, holds, found = "") => lines.push(`check ${name} ${holds ? "ok" : `FAILED ${found}`}`);
    const box = (id) => element(id).getBoundingClientRect();
    const shown = (selector) => [...document.querySelectorAll(selector)].filter((node) => node.offsetParent !== null);
    const stage = box("stage");
    check("the mesh has room", stage.width >= 400 && stage.height >= Math.min(300, 0.9 * innerHeight), `${stage.width} x ${stage.height}`);
    const [left, top, right, bottom] = [
        app.camera.pixel_x(app.view.home[0]),
        app.camera.pixel_y(app.view.home[3]),
        app.camera.pixel_x(app.view.home[2]),
        app.camera.pixel_y(app.view.home[1]),
    ];
    const note = box("hint");
    const apart = note.left - stage.left > right || note.right - stage.left < left ||
        note.top - stage.top > bottom || note.bottom - stage.top < top;
    check("the body is not under the hint", apart, `${note.top} ${note.bottom} ${top} ${bottom}`);
    check("nothing is wider than the window", document.documentElement.scrollWidth <= innerWidth);
    if (innerWidth <= 760 || innerHeight <= 480) {
        const small = shown("button, input").filter((node) => {
            const { width, height } = node.getBoundingClientRect();
            return Math.min(width, height) < 39.5;
        });
        check("fingers find everything", small.length === 0, small.map((node) => node.id || node.outerHTML).join());
    }
    const least = Math.min(...shown("aside *").map((node) => parseFloat(getComputedStyle(node).fontSize)));
    check("letters grow with the screen", least >= (innerWidth >= 2400 ? 18 : 11.5), least);
    if (matchMedia("(forced-colors: active)").matches) {
        app.movement.move_point(2, 0, 0.01);
        app.follow();
        const colour = (node, pseudo) => getComputedStyle(node, pseudo).backgroundColor;
        const panel = colour(document.querySelector("aside"));
        check("the gauge is seen", colour(element("gauge_fill")) !== panel &&
            getComputedStyle(element("gauge_fill")).forcedColorAdjust === "none");
        check("sliders are seen",
            getComputedStyle(document.querySelector("input[type=range]")).forcedColorAdjust === "none");
        check("the chosen colours are seen",
            colour(document.querySelector("#colour [aria-checked=true]")) !==
                colour(document.querySelector("#colour [aria-checked=false]")));
        check("pressed tools have the reader's colour", colour(document.querySelector(".tools [aria-pressed=true]")) ===
            colour(document.querySelector("#colour [aria-checked=true]")));
    }
    const result = document.createElement("pre");
    result.textContent = `\nresult begins\nvalue forced ${matchMedia("(forced-colors: active)").matches}\n` +
        `value window ${innerWidth}x${innerHeight}\n${lines.join("\n")}\nresult ends\n`;
    document.body.append(result);
})();
