"use strict";
// The report of one morph: page_data as in decode.js, without functions, and
//
//   dx, dy [points]           where every point went; moved [2*functions]: what hm_morph was given, as far as it came
//   inverted, self_crossing, admissible_step, min_quality, mean_quality, worst_cell, limiting_cell, boundary_error
//                             what the program found, of the whole mesh
//   safe, strategy, steps, resolves, step_fraction, untangled, refusal      the way of hm_morph_safe

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
        this.wall.judge(this.cells.step);
        this.sections = this.wall.chains
            .filter((chain) => chain.closed)
            .map((chain) => new Section(chain, data, this.after));
        for (const section of this.sections) section.judge();
        this.home = box_of_points(
            this.after.x,
            this.after.y,
            this.wall.points.map((wall) => wall.point),
        );
        this.extent = Math.max(this.home[2] - this.home[0], this.home[3] - this.home[1]);
        this.write_verdict();
        this.write_cards();
        this.write_moved();
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

    write_cards() {
        const { data, cells_before } = this,
            step = data.admissible_step === null ? Infinity : data.admissible_step;
        const strategies = ["one linear morph", "another basis", "several steps", "steps, then untangling", "steps, then better cells"];
        const cards = [
            ["Inverted cells", brief(data.inverted), `of ${data.all_cells.toLocaleString("en")}`],
            [
                "Admissible step",
                step === Infinity ? "unlimited" : `${brief(step)} ×`,
                "of this movement",
            ],
            ["Least quality", data.min_quality.toFixed(3), `before ${cells_before.min_quality.toFixed(3)}`],
            ["Mean quality", data.mean_quality.toFixed(4), `before ${cells_before.mean_quality.toFixed(4)}`],
            ["Boundary error", brief(data.boundary_error), "largest distance from the B-spline"],
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
        for (const { name, start, now } of this.sections) {
            cards.push([
                `Thickness, ${name}`,
                `${fixed(100 * now.thickness, 2)} %`,
                `before ${fixed(100 * start.thickness, 2)} %`,
            ]);
            cards.push([
                `Camber, ${name}`,
                `${fixed(100 * now.camber, 2)} %`,
                `before ${fixed(100 * start.camber, 2)} %`,
            ]);
            cards.push([`Area, ${name}`, brief(now.area), `before ${brief(start.area)}`]);
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

    // ---- Pictures

    // Light or dark as the reader's system is, but light on paper; drawn again where the page has another width.
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
        const { data, after, before, cells, cells_before, home, extent } = this,
            shown = { theme: this.theme, before: false };
        this.map("change", after, cells, home, 0.12, { ...shown, colour: "none", before: true });
        this.map("quality_before", before, cells_before, home, 0.12, { ...shown, colour: "quality" });
        this.map("quality_after", after, cells, home, 0.12, { ...shown, colour: "quality" });
        this.draw_scale();
        this.draw_histogram();
        element("wall_section").hidden = this.wall.layer.length === 0 || !(extent > 0);
        if (!element("wall_section").hidden) this.draw_wall();
        const order = [...cells.quality.keys()]
            .sort((one, other) => cells.quality[one] - cells.quality[other])
            .slice(0, 10);
        element("worst").replaceChildren();
        for (const cell of order) this.draw_close_up(cell);
        document.title = `Morph report: ${data.mesh}`;
    }

    map(canvas, model, cells, box, margin, options) {
        const its = typeof canvas === "string" ? element(canvas) : canvas,
            camera = new Camera(),
            painter = new CanvasPainter(its, this.data.pieces.points),
            { context } = painter;
        camera.resize(its.clientWidth, its.clientHeight);
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

    draw_histogram() {
        const n = 25,
            count = (values) => {
                const counts = new Array(n).fill(0);
                for (const value of values) ++counts[Math.min(Math.floor(n * value), n - 1)];
                return counts.map((its) => (100 * its) / values.length);
            };
        const before = count(this.cells_before.quality),
            after = count(this.cells.quality);
        const box = element("quality_histogram");
        const chart = new Chart({
            x: [0, 1],
            y: [0, Math.max(...before, ...after)],
            x_name: "quality; before in blue, after in red",
            width: box.clientWidth,
        });
        chart.bars(before, "var(--before)", 0.08, 0.4);
        chart.bars(after, "var(--after)", 0.52, 0.4);
        const rows = before.map((percent, bin) => [bin / n, (bin + 1) / n, percent, after[bin]]);
        chart.show_in(box, "Cells [%]", "quality", ["from", "to", "percent before", "percent after"], rows);
    }

    // Along each wall, from its first point, by the arc before anything moved.
    draw_wall() {
        const place = new Map(this.wall.layer.map((its, i) => [its.point, i])),
            { x, y } = this.before,
            curves = [],
            rows = [],
            columns = ["wall", "x before", "y before", "arc", "degrees", "height ratio"];
        let arc = 0;
        for (const { points, marker } of this.wall.chains) {
            const angle = [],
                height = [],
                its_name = this.data.markers[marker].name;
            points.forEach((point, k) => {
                if (k > 0) arc += Math.hypot(x[point] - x[points[k - 1]], y[point] - y[points[k - 1]]);
                const i = place.get(point);
                if (i === undefined) return;
                angle.push([arc, this.wall.angle[i]]);
                height.push([arc, this.wall.height[i]]);
                rows.push([its_name, x[point], y[point], arc, this.wall.angle[i], this.wall.height[i]]);
            });
            curves.push({ angle, height });
        }
        const all = (name) => curves.flatMap((curve) => curve[name].map(([, value]) => value));
        const put = (id, name, low, high, y_name) => {
            const box = element(id),
                room = 0.05 * (high - low);
            const chart = new Chart({
                x: [0, arc || 1],
                y: [low === 0 ? 0 : low - room, high + room],
                x_name: "arc along the wall before it moved",
                width: box.clientWidth,
            });
            for (const curve of curves) if (curve[name].length > 0) chart.curve(curve[name], "var(--after)");
            chart.show_in(box, y_name, "first_layer", columns, rows);
        };
        put(
            "angle_chart",
            "angle",
            0,
            Math.max(0.1, ...all("angle")),
            "Change of the angle between wall and first-layer edge [degrees]",
        );
        put(
            "height_chart",
            "height",
            Math.min(0.99, ...all("height")),
            Math.max(1.01, ...all("height")),
            "Height of the first layer, after over before",
        );
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
