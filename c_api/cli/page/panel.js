"use strict";
// The panel: verdict, histogram, table of the section, and the texts for screen readers.

const element = (id) => document.getElementById(id);

class Panel {
    constructor(app) {
        this.app = app;
        element("name").textContent = element("name").title = `${app.data.mesh} · ${app.data.operator}`;
        element("section_box").hidden = app.sections.length === 0;
        this.controls = new Controls(app);
        this.design = new Design(app, this.controls);
    }

    // Screen readers hear of a change once it is finished: while it goes on they would not come to an end.
    speak(text) {
        element("spoken").textContent = text;
    }
    speak_verdict() {
        this.speak(`${element("verdict_word").textContent}. ${element("verdict_detail").textContent}`);
    }
    speak_choice() {
        const [dx, dy] = this.app.movement.of_choice();
        this.speak(`${element("point_name").textContent}, moved by ${brief(dx)}, ${brief(dy)}`);
    }

    update() {
        this.update_verdict();
        this.update_colours();
        this.update_section();
        this.controls.update();
        this.design.update();
    }

    update_verdict() {
        const { app } = this,
            { cells, wall, still } = app,
            { inverted } = cells,
            { touch } = wall,
            step = app.admissible_step(),
            crosses = wall.crossing.length > 0,
            percent = short(Math.min(1, step) * 100),
            { reached } = app,
            qualities = `quality ${short(cells.min_quality)} at least, ${short(cells.mean_quality)} mean`;
        const words =
            inverted > 0
                ? `${inverted} inverted ${inverted === 1 ? "cell" : "cells"}`
                : crosses
                  ? "Wall crosses itself"
                  : "Valid mesh";
        element("verdict_word").textContent = words;
        element("verdict_detail").textContent =
            reached !== ""
                ? `${reached}; ${qualities}`
                : inverted > 0 || crosses
                ? `${percent} % of this movement is possible${inverted > 0 && crosses ? "; the wall crosses itself" : ""}`
                : still
                  ? "Nothing has moved yet"
                  : touch.point >= 0 && step < 2
                    ? "The wall touches itself before a cell inverts"
                    : qualities;
        for (const id of ["back_to_valid", "go_safely"]) element(id).hidden = app.is_valid() || reached !== "";
        const used = step === Infinity || reached !== "" ? 0 : Math.min(1, 1 / step);
        element("verdict").className =
            "verdict " + (inverted > 0 || crosses ? "bad" : used > 0.5 ? "warn good" : "good");
        element("gauge_fill").style.width = `${100 * used}%`;
        element("gauge").setAttribute("aria-valuenow", Math.round(100 * used));
        element("step").textContent =
            still || reached !== "" ? "–" : step === Infinity ? "unlimited" : `${short(step)} × this movement`;
    }

    update_section() {
        const { app } = this,
            section = app.selection.section();
        if (!section) return;
        element("section_name").textContent = section.name;
        element("section_name").hidden = app.sections.length === 1;
        const { start, now } = section,
            rows = [
                [`Thickness at ${(100 * now.thickest).toFixed(0)} %`, now.thickness * 100, start.thickness * 100, "%"],
                ["Camber", now.camber * 100, start.camber * 100, "%"],
                ["Chord", now.chord, start.chord, ""],
                ["Twist", now.twist, start.twist, "°"],
                ["Area", now.area, start.area, ""],
            ];
        for (const [name, text, unit] of [
            ["leading_edge_radius", "Leading-edge radius", ""],
            ["trailing_edge_angle", "Trailing-edge angle", "°"],
        ])
            if (now[name]) rows.push([text, now[name], start[name], unit]);
        const body = element("section").tBodies[0];
        while (body.rows.length < rows.length) {
            const row = body.insertRow(),
                name = document.createElement("th");
            name.scope = "row";
            row.append(name);
            for (let i = 0; i < 2; ++i) row.insertCell();
        }
        while (body.rows.length > rows.length) body.deleteRow(-1);
        rows.forEach(([name, value, before, unit], i) => {
            const cells = body.rows[i].cells,
                change = value - before,
                digits = unit === "" ? 4 : 2;
            const shown = Math.abs(change) >= 0.5 * 10 ** -digits;
            cells[0].textContent = name;
            cells[1].textContent = `${fixed(value, digits)}${unit === "°" ? "" : " "}${unit}`;
            cells[2].textContent = shown ? (change > 0 ? "+" : "") + fixed(change, digits) : "";
            cells[2].className = shown ? "changed" : "";
        });
    }

    update_colours() {
        const { app } = this,
            { colour } = app.options;
        element("histogram_box").hidden = colour === "none";
        if (colour === "none") return;
        const shown = app.legend.distribution();
        for (const end of ["low", "high"]) element("scale_" + end).textContent = shown[end + "_text"];
        element("scale_name").textContent = shown.name;
        element("colour_summary").textContent = shown.summary;
        this.draw_histogram(shown);
    }

    // Counts the values between low and high; the bars have the colours of the picture.
    draw_histogram({ values, low, high, colour_at }) {
        const canvas = element("histogram"),
            ratio = devicePixelRatio,
            width = canvas.clientWidth,
            height = canvas.clientHeight;
        canvas.width = width * ratio;
        canvas.height = height * ratio;
        const context = canvas.getContext("2d"),
            n = 40,
            counts = new Array(n).fill(0),
            strip = 8,
            quiet = style_of("--quiet"),
            bins_per_unit = n / (high - low);
        context.scale(ratio, ratio);
        for (let i = 0; i < values.length; ++i) {
            const bin = Math.floor((values[i] - low) * bins_per_unit);
            ++counts[Math.min(Math.max(bin, 0), n - 1)];
        }
        const most = Math.max(1, ...counts),
            tall = height - strip - 4;
        counts.forEach((count, bin) => {
            const left = (bin * width) / n,
                up = count === 0 ? 0 : Math.max(2, tall * Math.sqrt(count / most));
            context.fillStyle = quiet;
            context.fillRect(left + 0.5, tall - up, width / n - 1, up);
            context.fillStyle = colour_at(low + ((bin + 0.5) / n) * (high - low));
            context.fillRect(left, height - strip, width / n + 0.5, strip);
        });
    }
}
