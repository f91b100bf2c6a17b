"use strict";
// The skew quality of single cells, as the page computes it: lines "cell TYPE QUALITY X Y X Y ...", with VTK's type of
// the cell, and lines "check NAME ok" or "check NAME FAILED ..." as page.js leaves them.
(() => {
    const lines = [];
    // Numbers between 0 and 1, the same in each run.
    let seed = 1;
    const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
    const judge = (points, has_polygons) => {
        const data = {
            cell: [0],
            cell_start: Int32Array.of(0, points.length),
            cell_points: Int32Array.from(points.keys()),
            x: points.map(([x]) => x),
            y: points.map(([, y]) => y),
            has_polygons,
        };
        data.pieces = new Pieces(data);
        const still = points.map(() => 0),
            cells = new Cells(data, { x0: data.x, y0: data.y, x: data.x, y: data.y, dx: still, dy: still });
        cells.judge();
        return cells.quality[0];
    };
    // Corners round a stretched and turned ellipse at random distances.
    const corners = (n, spread, stretch) => {
        const turn = 7 * random();
        return Array.from({ length: n }, (_, k) => {
            const angle = (2 * Math.PI * (k + 0.6 * random())) / n,
                radius = 1 - spread * random(),
                [u, v] = [radius * Math.cos(angle), stretch * radius * Math.sin(angle)];
            return [3 + u * Math.cos(turn) - v * Math.sin(turn), u * Math.sin(turn) + v * Math.cos(turn)];
        });
    };
    let usual = 0;
    for (let trial = 0; trial < 45; ++trial) {
        const n = trial < 10 ? 3 : trial < 25 ? 4 : 5 + (trial % 4),
            stretch = [1, 0.3, 0.01][trial % 3],
            points = corners(n, n > 3 ? 0.6 : 0.2, stretch),
            quality = judge(points, n > 4);
        if (quality > 0 && quality < 1) ++usual;
        lines.push(`cell ${n === 3 ? 5 : n === 4 ? 9 : 7} ${quality} ${points.flat().join(" ")}`);
    }
    lines.push(`check most cells have a quality between 0 and 1 ${usual > 25 ? "ok" : `FAILED ${usual}`}`);
    const result = document.createElement("pre");
    result.textContent = `\nresult begins\n${lines.join("\n")}\nresult ends\n`;
    document.body.append(result);
})();
