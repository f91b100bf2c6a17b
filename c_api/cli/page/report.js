"use strict";
// The report of one morph. Its page_data is the one that report_decode.js describes, and has these, too:
//
//   dx, dy [points]           the displacement of each point
//   moved [2*functions]       the movements that hm_morph was given, as far as they were reached
//   inverted, self_crossing, admissible_step, min_quality, mean_quality, boundary_error, boundary_error_note
//                             the program's findings on the whole mesh
//   safe, strategy, steps, resolves, step_fraction, untangled, refusal
//                             the way that hm_move_safe went

const element = (id) => document.getElementById(id);

class Report {
    constructor(raw) {
        const data = (this.data = decode(raw));
        data.moved = decode_base64(raw.moved, Float64Array);
        const dx = decode_base64(raw.dx, Float64Array),
            dy = decode_base64(raw.dy, Float64Array),
            zero = new Float64Array(dx.length);
        const place = (mx, my) => ({
            n: dx.length,
            x0: data.x,
            y0: data.y,
            dx: mx,
            dy: my,
            x: data.x.map((x, k) => x + mx[k]),
            y: data.y.map((y, k) => y + my[k]),
        });
        this.before = place(zero, zero);
        this.after = place(dx, dy);
        this.cells_before = new Cells(data, this.before);
        this.cells = new Cells(data, this.after);
        this.wall = new Wall(data, this.after);
        for (const part of [this.cells_before, this.cells]) part.judge();
        this.wall.judge();
        this.sections = this.wall.chains
            .filter((chain) => chain.closed)
            .map((chain) => new Section(chain, data, this.after));
        this.home = box_of_points(
            this.after.x,
            this.after.y,
            this.wall.points.map((wall) => wall.point),
        );
        this.extent = Math.max(this.home[2] - this.home[0], this.home[3] - this.home[1]);
        this.write_verdict();
        new ReportNumbers(this).write();
        this.follow_the_reader();
        this.draw();
    }

    write_verdict() {
        const { data } = this,
            reached = data.refusal === "" && data.inverted === 0 && !data.self_crossing;
        const count = `${data.inverted} inverted ${data.inverted === 1 ? "cell" : "cells"}`;
        element("name").textContent = `${data.mesh} · ${data.operator} functions · harmorph ${data.version}`;
        element("verdict").className = "verdict " + (reached ? "good" : "bad");
        element("verdict_word").textContent = reached
            ? "Valid mesh"
            : data.inverted > 0
              ? count
              : data.self_crossing
                ? "The boundary crosses itself"
                : "The target was not reached";
        element("verdict_detail").textContent = data.refusal;
        const rest = data.all_cells - data.cells;
        element("footnote").textContent =
            `Numbers at the top are of all ${data.all_cells.toLocaleString("en")} cells` +
            (rest === 0
                ? "."
                : `; maps, histogram and worst cells of the ${data.cells.toLocaleString("en")} nearest to the body.`);
    }

    // ---- Pictures

    // The report is light or dark as the reader's system is, but light on paper. A page of another width is drawn
    // again.
    follow_the_reader() {
        const dark = matchMedia("(prefers-color-scheme: dark)");
        let width = innerWidth,
            timer = 0;
        this.set_theme(dark.matches ? "dark" : "light");
        const change_to = (theme) => {
            this.set_theme(theme);
            this.draw();
        };
        dark.onchange = () => change_to(dark.matches ? "dark" : "light");
        window.onbeforeprint = () => change_to("light");
        window.onafterprint = dark.onchange;
        window.onresize = () => {
            if (innerWidth === width) return;
            width = innerWidth;
            clearTimeout(timer);
            timer = setTimeout(() => this.draw(), 200);
        };
    }

    set_theme(theme) {
        this.theme = theme;
        document.documentElement.classList.toggle("dark", theme === "dark");
    }

    draw() {
        const { data, after, before, cells, cells_before, home } = this,
            shown = { theme: this.theme, before: false };
        this.map(element("change"), after, cells, home, 0.12, { ...shown, colour: "none", before: true });
        this.map(element("quality_before"), before, cells_before, home, 0.12, { ...shown, colour: "quality" });
        this.map(element("quality_after"), after, cells, home, 0.12, { ...shown, colour: "quality" });
        this.draw_scale();
        new ReportCharts(this).draw();
        const order = [...cells.quality.keys()]
            .sort((one, other) => cells.quality[one] - cells.quality[other])
            .slice(0, 10);
        element("worst").replaceChildren();
        for (const cell of order) this.draw_close_up(cell);
        document.title = `Morph report: ${data.mesh}`;
    }

    // Draws a mesh in a box of the plane; returns a function that makes a path of mesh points.
    map(canvas, model, cells, box, margin, options) {
        const camera = new Camera(),
            painter = new CanvasPainter(canvas, this.data.pieces.points),
            { context } = painter;
        camera.resize(canvas.clientWidth, canvas.clientHeight);
        camera.fit(box, margin);
        const picture = new Picture(this.data, model, cells, painter);
        picture.draw(camera, 2, options);
        const path = (points, closed) => {
            context.beginPath();
            for (const k of points) context.lineTo(camera.pixel_x(model.x[k]), camera.pixel_y(model.y[k]));
            if (closed) context.closePath();
        };
        for (const chain of this.wall.chains) {
            path(chain.points, chain.closed);
            context.strokeStyle = style_of("--wall");
            context.lineWidth = 1.5;
            context.stroke();
        }
        return { context, path, camera };
    }

    draw_scale() {
        const canvas = element("quality_scale"),
            context = canvas.getContext("2d");
        [canvas.width, canvas.height] = [256, 1];
        for (let i = 0; i < 256; ++i) {
            context.fillStyle = scales[this.theme].good.css(i / 255);
            context.fillRect(i, 0, 1, 1);
        }
    }

    draw_close_up(cell) {
        const figure = document.createElement("figure"),
            canvas = document.createElement("canvas");
        const caption = document.createElement("figcaption"),
            { after, cells, data } = this;
        figure.append(canvas, caption);
        element("worst").append(figure);
        const corners = cells.corners(cell),
            digits = Math.max(0, 5 - Math.floor(Math.log10(this.extent || 1))),
            [x, y] = cells.centre(cell, after.x, after.y).map((at) => fixed(at, digits));
        const { context, path } = this.map(canvas, after, cells, box_of_points(after.x, after.y, corners), 0.3, {
            theme: this.theme,
            before: false,
            colour: "quality",
        });
        path(corners, true);
        context.strokeStyle = style_of("--ink");
        context.lineWidth = 2.5;
        context.stroke();
        caption.textContent =
            `cell ${data.cell[cell]}: ${cells.quality[cell] === 0 ? "inverted" : brief(cells.quality[cell])}\n` +
            `at ${x}, ${y}`;
    }
}

const report = new Report(page_data);
