"use strict";
// Milliseconds of a frame of the page of `harmorph explore`, drawn in software: the median and the least of 21
// frames, each with another part of the plane. The first frames are slower, until the browser has compiled the scripts;
// on a machine that does other things, the least is more reliable. Leaves lines of a table in the element `result`.
(() => {
    const lines = [],
        text = (number) => number.toFixed(0).padStart(8),
        row = (name, list) => {
            list.sort((a, b) => a - b);
            lines.push(name.padEnd(44) + text(list[list.length >> 1]) + text(list[0]));
        };
    const time = (name, action) => {
        const list = [];
        for (let i = 0; i < 21; ++i) {
            const begin = performance.now();
            action(i);
            app.draw();
            app.picture.painter.finish();
            list.push(performance.now() - begin);
        }
        row(name, list);
    };
    lines.push(`${app.cells.n} cells, ${app.model.n} points, ${app.picture.painter.constructor.name}, ` +
        `${app.camera.width} x ${app.camera.height} pixels`, `${"milliseconds of a frame".padEnd(44)}  median   least`);
    for (const colour of ["none", "quality", "function"]) {
        document.querySelector(`#colour [data-value=${colour}]`).click();
        for (const [name, closer] of [["all of the mesh", 0.1], ["the body", 1], ["the leading edge", 20]]) {
            app.view.fit();
            if (closer === 20) app.camera.fit([app.view.home[0], -0.01, app.view.home[0] + 0.04, 0.01], 0.1);
            else app.camera.zoom(closer);
            time(`zoom, ${colour === "none" ? "mesh" : colour}, ${name}`, (i) => app.camera.zoom(i % 2 ? 1.05 : 1 / 1.05));
        }
    }
    document.querySelector("#colour [data-value=quality]").click();
    app.view.fit();
    const following = [];
    time("drag, quality, the body", (i) => {
        app.movement.move_point(3, 0, 0.001 * (i + 1) * app.view.extent);
        app.follow();
        following.push(app.times.morph + app.times.judge);
    });
    row("    morph and judge alone", following);
    const result = document.createElement("pre");
    result.textContent = `\nresult begins\n${lines.join("\n")}\nresult ends\n`;
    document.body.append(result);
})();
