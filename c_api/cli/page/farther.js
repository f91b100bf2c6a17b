"use strict";
// What one sum of functions does not reach: safe morphs, other airfoils, and displacements of single wall points.

// Returns the numbers of the lines that have as many numbers as the first such line; other lines are titles.
function rows_of_numbers(text) {
    const rows = text
        .split("\n")
        .map((line) => line.replace(/#.*/, "").trim().split(/[\s,;]+/).map(Number))
        .filter((row) => row.length > 1 && row.every(Number.isFinite));
    return rows.filter((row) => row.length === rows[0].length);
}

class Farther {
    constructor(app) {
        this.app = app;
        element("go_safely").onclick = () => this.begin("Solving on the way …", () => this.safe());
    }

    // Computes when the browser has shown the message; shows why a call is refused.
    begin(text, action) {
        const { files } = this.app;
        files.say(text);
        setTimeout(() => {
            try {
                files.say(action() ?? "");
            } catch (error) {
                files.say(error.message);
            }
        }, 20);
    }

    // Takes the mesh to the present control points and bodies by hm_move_safe.
    safe() {
        const { app } = this,
            { points, report } = app.model.morph.safe(app.moves),
            several = "several steps",
            ways = ["one step", "another basis", several, `${several} and untangling`, `${several} and better cells`];
        app.model.move_to(points);
        app.show_reached(
            `Reached by ${ways[report.strategy]}, ${plural(report.solutions, "solution")}` +
                (report.stepFraction < 1 ? `; ${brief(100 * report.stepFraction)} % of this movement was reached` : ""),
        );
    }

    // Makes a section another airfoil, whose chord is put on that of the section; returns how near it comes.
    airfoil(text, name) {
        const { app } = this,
            section = app.selection.section();
        if (section === undefined) throw new Error(`${name}: there is no section that could become this airfoil`);
        const [curve] = section.curves.curves,
            { move, report } = app.model.curves.refit(Farther.outline(text), true, { curve, onChord: true });
        app.after(() => app.shape.become(section, move));
        return `${name}: the curve is within ${brief(report.maxError / report.chord)} chords of all points`;
    }

    // Returns the points of an airfoil file, in Selig's order, also of a file in Lednicer's order, whose first line has
    // the numbers of points of both sides, each from the leading edge.
    static outline(text) {
        let rows = rows_of_numbers(text).filter((row) => row.length === 2);
        const [upper, lower] = rows[0] ?? [];
        if (upper + lower === rows.length - 1 && upper > 1) {
            rows = rows.slice(1);
            rows = [...rows.slice(0, upper).reverse(), ...rows.slice(upper)];
        }
        rows = rows.filter(([x, y], k) => k === 0 || x !== rows[k - 1][0] || y !== rows[k - 1][1]);
        const [first, last] = [rows[0], rows[rows.length - 1]];
        if (rows.length > 1 && first.join() === last.join()) rows.pop();
        return Float64Array.from(rows.flat());
    }

    // Moves wall points as lines "point dx dy" say, for all points of some markers.
    displace(text, name) {
        const { app } = this,
            { model, data } = app,
            rows = rows_of_numbers(text),
            listed = new Set(rows.map(([point]) => point)),
            markers = data.markers.map((_, marker) => marker).filter((marker) => {
                const points = app.wall.faces.filter((face) => face.marker === marker).flatMap(({ a, b }) => [a, b]);
                return points.length > 0 && points.every((point) => listed.has(point));
            });
        if (markers.length === 0)
            throw new Error(`${name}: the file must have the displacements of all points of a marker`);
        const given = new model.classes.Morph(model.mesh, null, markers.map((marker) => [marker, "given"])),
            wallPoints = Int32Array.from(rows, ([point]) => point),
            wall = Float64Array.from(rows.flatMap(([, dx, dy]) => [dx, dy]));
        try {
            const displacements = given.displace(wall, { wallPoints });
            if (given.assess(displacements).quality.inverted === 0) model.move_by(displacements);
            else model.move_to(given.displaceSafe(wall, { wallPoints }).points);
        } finally {
            given.free();
        }
        app.show_reached(`The wall points of ${name} are displaced`, true);
    }
}
