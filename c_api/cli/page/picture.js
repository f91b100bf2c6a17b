"use strict";
// What lies behind the handles: mesh before and after, cells in colour, contours.

class Picture {
    constructor(canvas, data, model, cells, painter = make_painter(canvas)) {
        Object.assign(this, { data, model, cells, painter });
        this.screen = new Float32Array(2 * model.n);
        this.screen_before = new Float32Array(2 * model.n);
        this.edges = Picture.edges_of(data);
        this.thin_edges = new Uint32Array(data.thin_edges);
        const most = 2 * (data.pieces.points.length / 4);
        this.positions = new Float32Array(6 * most);
        this.colours = new Uint8Array(12 * most);
        this.contours = new Contours();
        this.values = null; // of the function shown
    }

    // Each edge once.
    static edges_of(data) {
        const seen = new Set(),
            pairs = [],
            n = data.x.length;
        for_each_side(data, (a, b) => {
            const key = Math.min(a, b) * n + Math.max(a, b);
            if (seen.has(key)) return;
            seen.add(key);
            pairs.push(a, b);
        });
        return new Uint32Array(pairs);
    }

    // options: colour ("none", "quality", "function", ...), before, theme; values: of the function, at the points.
    draw(camera, ratio, options) {
        const { painter, model, screen } = this,
            scale = scales[options.theme];
        painter.begin(camera.width, camera.height, ratio, colour_of("--canvas"));
        camera.project(model.x, model.y, screen);
        const n =
            options.colour === "quality"
                ? this.colour_cells(scale.good)
                : options.colour === "function" && this.values
                  ? this.colour_points(scale.function)
                  : 0;
        painter.triangles(this.positions, this.colours, n);
        const line = colour_of("--mesh"),
            strong = n > 0 ? 0.35 : 0.75;
        painter.lines(screen, this.thin_edges, [...line, strong / 2]);
        painter.lines(screen, this.edges, [...line, strong]);
        if (options.before) this.draw_before_and_after(camera);
        if (options.colour === "function" && this.values) this.draw_contours();
        if (this.cells.inverted > 0) painter.triangles(this.positions, this.colours, this.colour_inverted());
    }

    // Only edges that have visibly moved: elsewhere blue under red would be neither.
    draw_before_and_after(camera) {
        const { edges, screen, screen_before, model, painter } = this,
            least = 0.6; // [pixels]
        camera.project(model.x0, model.y0, screen_before);
        this.before = this.before || new Float32Array(2 * edges.length);
        this.after = this.after || new Float32Array(2 * edges.length);
        let n = 0;
        const moved = (k) => Math.abs(model.dx[k]) + Math.abs(model.dy[k]) > least / camera.scale;
        for (let i = 0; i < edges.length; i += 2) {
            if (!moved(edges[i]) && !moved(edges[i + 1])) continue;
            for (let end = 0; end < 2; ++end) {
                const from = 2 * edges[i + end],
                    to = 4 * n + 2 * end;
                this.before[to] = screen_before[from];
                this.before[to + 1] = screen_before[from + 1];
                this.after[to] = screen[from];
                this.after[to + 1] = screen[from + 1];
            }
            ++n;
        }
        painter.segments(this.before, n, [...colour_of("--before"), 0.6]);
        painter.segments(this.after, n, [...colour_of("--after"), 0.7]);
    }

    draw_contours() {
        this.contours.find(this.data.pieces.points, this.screen, this.values, this.level_distance());
        this.painter.segments(this.contours.positions, this.contours.n, [...colour_of("--ink"), 0.9]);
    }

    value_range() {
        let low = 0,
            high = 0;
        for (const value of this.values) {
            low = Math.min(low, value);
            high = Math.max(high, value);
        }
        return [low, high];
    }

    level_distance() {
        const [low, high] = this.value_range();
        return high - low > 1.2 ? 0.2 : 0.1;
    }

    put_triangle(n, a, b, c) {
        const { positions, screen } = this,
            at = 6 * n;
        positions[at] = screen[2 * a];
        positions[at + 1] = screen[2 * a + 1];
        positions[at + 2] = screen[2 * b];
        positions[at + 3] = screen[2 * b + 1];
        positions[at + 4] = screen[2 * c];
        positions[at + 5] = screen[2 * c + 1];
    }

    put_colour(corner, red, green, blue) {
        const at = 4 * corner;
        this.colours[at] = red;
        this.colours[at + 1] = green;
        this.colours[at + 2] = blue;
        this.colours[at + 3] = 255;
    }

    // The triangles of some cells, each cell in the bytes of its colour; their number.
    fill(is_wanted, bytes_of) {
        const { start, points } = this.data.pieces;
        let n = 0;
        for (let cell = 0; cell < this.cells.n; ++cell) {
            if (!is_wanted(cell)) continue;
            const [red, green, blue] = bytes_of(cell),
                first = n;
            for (let k = 4 * start[cell]; k < 4 * start[cell + 1]; k += 4) {
                const [a, b, c, d] = [points[k], points[k + 1], points[k + 2], points[k + 3]];
                this.put_triangle(n++, a, b, c);
                if (d !== c) this.put_triangle(n++, a, c, d);
            }
            for (let corner = 3 * first; corner < 3 * n; ++corner) this.put_colour(corner, red, green, blue);
        }
        return n;
    }

    colour_cells(scale) {
        const { quality } = this.cells;
        return this.fill(
            () => true,
            (cell) => scale.at(quality[cell]),
        );
    }

    colour_inverted() {
        const red = colour_of("--bad").map((part) => 255 * part),
            { quality } = this.cells;
        return this.fill(
            (cell) => quality[cell] === 0,
            () => red,
        );
    }

    colour_points(scale) {
        const p = this.data.pieces.points,
            [low, high] = this.value_range(),
            n = this.fill(
                () => true,
                () => [0, 0, 0],
            );
        let corner = 0;
        const put = (k) => {
            const [red, green, blue] = scale.at((this.values[k] - low) / (high - low || 1));
            this.put_colour(corner++, red, green, blue);
        };
        for (let k = 0; k < p.length; k += 4) {
            for (const place of p[k + 3] !== p[k + 2] ? [0, 1, 2, 0, 2, 3] : [0, 1, 2]) put(p[k + place]);
        }
        return n;
    }
}
