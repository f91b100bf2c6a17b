"use strict";
// The numbers of the report: cards of the whole mesh and of the sections, and the table of the movements.

class ReportNumbers {
    constructor({ data }) {
        this.data = data;
    }

    write() {
        this.write_cards();
        this.write_moved();
    }

    write_cards() {
        const { data } = this,
            step = data.admissible_step === null ? Infinity : data.admissible_step;
        const strategies = [
            "one linear morph",
            "another basis",
            "several steps",
            "steps, then untangling",
            "steps, then better cells",
        ];
        const cards = [
            ["Inverted cells", brief(data.inverted), `of ${data.all_cells.toLocaleString("en")}`],
            [
                "Admissible step",
                step === Infinity ? "unlimited" : `${brief(step)} ×`,
                "of this movement",
            ],
            ["Least quality", data.min_quality.toFixed(3), `before ${data.min_quality_before.toFixed(3)}`],
            ["Mean quality", data.mean_quality.toFixed(4), `before ${data.mean_quality_before.toFixed(4)}`],
            ["Boundary error", brief(data.boundary_error), data.boundary_error_note],
        ];
        if (data.safe) {
            cards.push([
                "The way",
                data.steps === 0 ? "no step" : strategies[data.strategy],
                `${plural(data.steps, "step")}, ${plural(data.resolves, "new solution")}` +
                    (data.untangled > 0 ? `, ${plural(data.untangled, "cell")} untangled` : ""),
            ]);
            cards.push(["Of the movement", `${brief(100 * data.step_fraction)} %`, "was reached"]);
        }
        const percent = (part) => `${fixed(100 * part, 2)} %`;
        for (const { name, thickness, camber, area, thickness_now, camber_now, area_now } of data.sections) {
            cards.push([`Thickness, ${name}`, percent(thickness_now), `before ${percent(thickness)}`]);
            cards.push([`Camber, ${name}`, percent(camber_now), `before ${percent(camber)}`]);
            cards.push([`Area, ${name}`, brief(area_now), `before ${brief(area)}`]);
        }
        element("cards").style.setProperty("--columns", cards.length % 5 === 0 ? 5 : 4); // full rows
        for (const [name, value, note] of cards) {
            const card = document.createElement("div");
            for (const [kind, text] of [
                ["dt", name],
                ["dd", value],
                ["small", note],
            ]) {
                const line = document.createElement(kind);
                line.textContent = text;
                card.append(line);
            }
            element("cards").append(card);
        }
    }

    write_moved() {
        const { data } = this,
            { moved } = data,
            rows = [];
        for (let i = 0; i < data.n_control; ++i) {
            if (moved[2 * i] !== 0 || moved[2 * i + 1] !== 0)
                rows.push([`control point ${i + 1}`, moved[2 * i], moved[2 * i + 1], "", ""]);
        }
        data.bodies.forEach((body, place) => {
            const [dx, dy, re, im] = moved.subarray(2 * data.n_control + 4 * place);
            rows.push([body.marker, dx, dy, (Math.atan2(im, 1 + re) * 180) / Math.PI, Math.hypot(1 + re, im)]);
        });
        const put = (row, texts, kind) =>
            texts.forEach((text) => {
                const cell = document.createElement(kind);
                cell.textContent = typeof text === "number" ? brief(text) : text;
                row.append(cell);
            });
        const names = data.bodies.length > 0 ? ["", "dx", "dy", "degrees", "scale"] : ["", "dx", "dy"];
        put(element("moved").tHead.insertRow(), names, "th");
        for (const row of rows) put(element("moved").tBodies[0].insertRow(), row.slice(0, names.length), "td");
        element("moved_section").hidden = rows.length === 0;
    }
}
