"use strict";
// The picture lies behind the overlay: the mesh before and after, cells in colour, contours.

// Returns the edges of the cells, each once: pairs of points, spacing, the least distance to the next line beside an
// edge before anything moves, and least_scale, the scale from which on an edge is drawn where lines are thinned,
// because they lie closer together than half a pixel. The edges are sorted by powers of two of least_scale; neighbours
// in the mesh stay together.
function edges_of(data) {
    const places = new Map(),
        pairs = [],
        spacing = [],
        { x, y, cell_start, cell_points } = data,
        n = x.length;
    for (let cell = 0; cell + 1 < cell_start.length; ++cell) {
        const row = cell_points.subarray(cell_start[cell], cell_start[cell + 1]);
        let area = 0;
        for_each_pair(row, (a, b) => (area += 0.5 * ((x[a] - x[row[0]]) * (y[b] - y[row[0]]) -
            (x[b] - x[row[0]]) * (y[a] - y[row[0]]))));
        for_each_pair(row, (a, b) => {
            const key = Math.min(a, b) * n + Math.max(a, b),
                across = Math.abs(area) / Math.hypot(x[b] - x[a], y[b] - y[a]);
            if (!places.has(key)) {
                places.set(key, spacing.length);
                pairs.push(a, b);
                spacing.push(across);
            }
            const place = places.get(key);
            spacing[place] = Math.min(spacing[place], across);
        });
    }
    const part = (i) => ((i * 0.6180339887) % 1) / 2, // of the lines, equally distributed
        order = Uint32Array.from(spacing.keys()),
        least = Float32Array.from(spacing, (distance, i) => part(i) / distance),
        power = Int32Array.from(least, (scale) => Math.max(-1000, Math.floor(Math.log2(scale))));
    order.sort((i, j) => power[i] - power[j] || i - j);
    return {
        pairs: Uint32Array.from({ length: pairs.length }, (_, k) => pairs[2 * order[k >> 1] + (k & 1)]),
        spacing: Float32Array.from(order, (i) => spacing[i]),
        least_scale: Float32Array.from(order, (i) => least[i]),
    };
}

// Calls visit(a, b) for each side of a closed row of points.
function for_each_pair(row, visit) {
    for (let k = 0; k < row.length; ++k) visit(row[k], row[k + 1 < row.length ? k + 1 : 0]);
}


class Picture {
    constructor(data, model, cells, painter) {
        Object.assign(this, { data, model, cells, painter });
        this.screen = new Float32Array(2 * model.n);
        this.screen_before = new Float32Array(2 * model.n);
        this.edges = data.edges = data.edges || edges_of(data);
        // Lines beyond the cells, which are thinned already: those of a report.
        const thin_edges = data.thin_edges ?? [];
        this.thin_edges = {
            pairs: new Uint32Array(thin_edges),
            spacing: new Float32Array(thin_edges.length / 2).fill(Infinity),
            least_scale: new Float32Array(thin_edges.length / 2),
        };
        this.piece_values = new Float32Array(data.pieces.points.length / 4);
        this.point_values = new Float32Array(model.n); // of the function that is shown, scaled to 0..1
        this.contours = new Contours();
        this.values = null; // of the function that is shown
    }

    // options are colour ("none", "quality", "function", ...), before, and theme.
    draw(camera, ratio, options) {
        const { painter, model, screen, cells } = this,
            { colour } = options,
            scale = scales[options.theme],
            shows_function = colour === "function" && this.values !== null;
        painter.begin(camera.width, camera.height, ratio, colour_of("--canvas"));
        camera.project(model.x, model.y, screen);
        painter.place(screen);
        if (shows_function) painter.fill_points(this.point_values, scale.function);
        if (colour === "quality" || cells.inverted > 0)
            painter.fill_cells(this.values_of_pieces(colour === "quality"), scale.good, colour_of("--bad"));
        const line = colour_of("--mesh"),
            is_coloured = shows_function || colour === "quality",
            strong = is_coloured ? 0.5 : 0.75;
        painter.lines(this.thin_edges, [...line, strong / 3], camera.scale, false);
        painter.lines(this.edges, [...line, strong], camera.scale, is_coloured);
        if (options.before) this.draw_before_and_after(camera);
        if (shows_function) this.draw_contours(camera);
        painter.end();
    }

    // Draws edges that have visibly moved; elsewhere red lines over blue ones would show neither colour.
    draw_before_and_after(camera) {
        const { screen, screen_before, model, painter } = this,
            edges = this.edges.pairs,
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

    draw_contours({ width, height }) {
        this.contours.find(this.data.pieces.points, this.screen, this.values, this.level_distance, width, height);
        this.painter.segments(this.contours.positions, this.contours.n, [...colour_of("--ink"), 0.9]);
    }

    // Takes the values of the function that is shown, at the points; sets their range and the distance of contour
    // lines.
    set_values(values) {
        let low = 0,
            high = 0;
        for (let k = 0; k < values.length; ++k) {
            low = Math.min(low, values[k]);
            high = Math.max(high, values[k]);
        }
        Object.assign(this, { values, value_range: [low, high], level_distance: high - low > 1.2 ? 0.2 : 0.1 });
        const span = high - low || 1;
        for (let k = 0; k < values.length; ++k) this.point_values[k] = (values[k] - low) / span;
    }

    // Returns the quality of the cell of each piece, or values that show inverted cells alone.
    values_of_pieces(all) {
        const { start } = this.data.pieces,
            { quality, n } = this.cells;
        for (let cell = 0; cell < n; ++cell) {
            const value = quality[cell] === 0 ? cell_value.bad : all ? quality[cell] : cell_value.hidden;
            for (let piece = start[cell]; piece < start[cell + 1]; ++piece) this.piece_values[piece] = value;
        }
        return this.piece_values;
    }
}
