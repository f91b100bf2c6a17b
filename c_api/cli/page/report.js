"use strict";
// The report of one morph. The program writes `page_data`, one object, whose arrays are little-endian numbers in base
// 64; the report draws what the program has computed.
//
//   version, mesh, operator   text
//   all_cells, cells          numbers of cells of the whole mesh and of this page
//   x, y, dx, dy [points]     coordinates before anything moves, and displacements
//   cell [cells]              the places of the cells in the mesh
//   cell_start [cells+1], cell_points         rows of points
//   quality_before, quality_after [cells]     0 for inverted cells
//   thin_edges [2*]           the lines that are drawn beyond the cells
//   walls                     the walls that move, each with the name of its marker, `closed`, its points in order, and
//                             for each point the arc before anything moved, and the angle [degrees] and the height
//                             [after over before] by which the first layer has changed; NaN: no first layer there
//   sections                  of closed walls: name, thickness and camber [chords] and area, before and now
//   n_control, bodies         number of control points, the marker of each rigid body
//   moved [2*functions]       the movements that hm_morph was given, as far as they were reached
//   inverted, self_crossing, admissible_step, min_quality, mean_quality, min_quality_before, mean_quality_before,
//   boundary_error, boundary_error_note       the findings on the whole mesh
//   safe, strategy, steps, resolves, step_fraction, untangled, refusal
//                             the way that hm_move_safe went

function decode(raw) {
    const read = (from, names, Numbers) =>
        Object.fromEntries(names.map((name) => [name, decode_base64(from[name], Numbers)]));
    const points = read(raw, ["x", "y", "dx", "dy", "moved", "quality_before", "quality_after"], Float64Array),
        cells = read(raw, ["cell", "cell_start", "cell_points", "thin_edges"], Int32Array);
    return {
        ...raw,
        ...points,
        ...cells,
        pieces: pieces_of(cells, points.x, points.y),
        walls: raw.walls.map((wall) => ({
            ...wall,
            ...read(wall, ["points"], Int32Array),
            ...read(wall, ["arc", "angle", "height"], Float64Array),
        })),
    };
}

const element = (id) => document.getElementById(id);

class Report {
    constructor(raw) {
        const data = (this.data = decode(raw)),
            { x, y, dx, dy } = data,
            zero = new Float64Array(x.length),
            moved = (from, by) => from.map((at, k) => at + by[k]);
        this.before = { n: x.length, x0: x, y0: y, dx: zero, dy: zero, x, y };
        this.after = { n: x.length, x0: x, y0: y, dx, dy, x: moved(x, dx), y: moved(y, dy) };
        this.cells_before = new Cells(data, data.quality_before);
        this.cells = new Cells(data, data.quality_after);
        this.home = box_of_points(
            this.after.x,
            this.after.y,
            data.walls.flatMap(({ points }) => [...points]),
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
        for (const { points, closed } of this.data.walls) {
            path(points, closed);
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
