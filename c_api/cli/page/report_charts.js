"use strict";
// The charts of the report: the histogram of the quality, and the first layer along the walls.

class ReportCharts {
    constructor({ data, before, extent }) {
        Object.assign(this, { data, before });
        const has_layer = data.walls.some(({ angle }) => angle.some((value) => value >= 0));
        element("wall_section").hidden = !has_layer || !(extent > 0);
    }

    draw() {
        this.draw_histogram();
        if (!element("wall_section").hidden) this.draw_wall();
    }

    draw_histogram() {
        const n = 25,
            count = (values) => {
                const counts = new Array(n).fill(0);
                for (const value of values) ++counts[Math.min(Math.floor(n * value), n - 1)];
                return counts.map((number) => (100 * number) / values.length);
            };
        const before = count(this.data.quality_before),
            after = count(this.data.quality_after);
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

    // Draws the first layer along the walls, one after another, over the arc before anything moved.
    draw_wall() {
        const { x, y } = this.before,
            curves = [],
            rows = [],
            columns = ["wall", "x before", "y before", "arc", "degrees", "height ratio"];
        let length = 0;
        for (const { marker, points, arc, angle, height } of this.data.walls) {
            const curve = { angle: [], height: [] };
            points.forEach((point, k) => {
                if (Number.isNaN(angle[k])) return;
                curve.angle.push([arc[k], angle[k]]);
                curve.height.push([arc[k], height[k]]);
                rows.push([marker, x[point], y[point], arc[k], angle[k], height[k]]);
            });
            curves.push(curve);
            length = arc[arc.length - 1];
        }
        const all = (name) => curves.flatMap((curve) => curve[name].map(([, value]) => value));
        const put = (id, name, low, high, y_name) => {
            const box = element(id),
                room = 0.05 * (high - low);
            const chart = new Chart({
                x: [0, length || 1],
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
}
