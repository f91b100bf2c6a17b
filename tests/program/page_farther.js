"use strict";
// Goes where one linear step does not lead, on the page of `harmorph explore`: wanted.what is safe, airfoil or
// displace. Leaves "moves", the file with which the program does the same, and "end", and lines "check ..." and
// "point ..." as page.js does.
(() => {
    const lines = [];
    const check = (name, holds, found = "") => lines.push(`check ${name} ${holds ? "ok" : `FAILED ${found}`}`);
    const { model, farther, data } = app;
    const verdict = () => element("verdict_word").textContent + ". " + element("verdict_detail").textContent;
    const finish = (text) => {
        for (let k = 0; k < model.n; ++k) lines.push(`point ${k} ${model.x[k]} ${model.y[k]}`);
        lines.push("moves", text.trimEnd(), "end");
    };
    // A turn about the quarter chord, too far for one step.
    const safe = () => {
        const [c, s] = [Math.cos(2.967) - 1, Math.sin(2.967)];
        const movements = Array.from({ length: data.n_control }, (_, i) => {
            const [x, y] = [data.control[2 * i] - 0.25, data.control[2 * i + 1]];
            return [i, [c * x - s * y, s * x + c * y]];
        });
        app.movement.move_points(new Map(movements));
        app.commit();
        check("the movement is too far for one step", !app.is_valid());
        check("a button goes there in several steps", !element("go_safely").hidden);
        element("save").click();
        const text = app.shape.text();
        farther.safe();
        check("the mesh is valid", app.is_valid() && app.cells.min_quality > 0.05, verdict());
        check("the verdict says how", /^Valid mesh\. Reached by several steps/.test(verdict()), verdict());
        check("the button is gone", element("go_safely").hidden);
        finish(text);
        app.undo();
        check("undo leads back", app.still && app.reached === "" && app.is_valid());
    };
    const airfoil = () => {
        const said = farther.airfoil(wanted.text, "airfoil.dat");
        check("the page says how near the curve comes", /within \S+ chords/.test(said), said);
        const { thickness, camber } = app.sections[0].now;
        check("the section is that of the file", Math.abs(thickness - 0.12) < 2e-3 && Math.abs(camber - 0.02) < 1e-3,
            `${thickness} ${camber}`);
        finish(wanted.text);
        const sides = wanted.text.trim().split("\n").slice(1),
            half = (sides.length - 1) / 2,
            lednicer = ["title", `${half + 1}. ${half + 1}.`, ...sides.slice(0, half + 1).reverse(), ...sides.slice(half)];
        const [one, other] = [wanted.text, lednicer.join("\n")].map((text) => Farther.outline(text));
        check("Lednicer's order is the same airfoil", one.every((value, k) => value === other[k]));
    };
    const displace = () => {
        const points = app.wall.chains[0].points,
            text = points.map((k) => `${k} ${0.01 * data.x[k] ** 2} ${0.05 * data.x[k] * (1 - data.x[k])}`).join("\n");
        app.files.take(text, "wall.txt"); // which begins with a message
        farther.displace(text, "wall.txt");
        check("the verdict says what moved", /wall points of wall.txt/.test(verdict()), verdict());
        const k = points[7];
        check("wall points are where the file says", model.dy[k] === 0.05 * data.x[k] * (1 - data.x[k]));
        finish(text);
        let refusal = "";
        try {
            farther.displace("0 1 1\n1 1 1\n", "two.txt");
        } catch (error) {
            refusal = error.message;
        }
        check("a file of some points is refused", /all points of a marker/.test(refusal), refusal);
    };
    ({ safe, airfoil, displace })[wanted.what]();
    const result = document.createElement("pre");
    result.textContent = `\nresult begins\n${lines.join("\n")}\nresult ends\n`;
    document.body.append(result);
})();
