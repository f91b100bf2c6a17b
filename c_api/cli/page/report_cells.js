"use strict";
// The size-skew quality of cells, by the formula of hm_assess. DividedCell judges cells that are divided (see
// report_polygons.js).

class Cells {
    constructor(data, model) {
        this.model = model;
        this.n = data.cell.length;
        this.data = data;
        this.pieces = data.pieces;
        this.quality = new Float64Array(this.n); // of each cell; 0 if the cell is inverted
        this.min_quality = this.mean_quality = 1;
        this.reference_area = new Float64Array(this.n);
        for (let cell = 0; cell < this.n; ++cell) this.reference_area[cell] = this.area(cell, model.x0, model.y0);
    }

    corners(cell) {
        const { cell_start, cell_points } = this.data;
        return cell_points.subarray(cell_start[cell], cell_start[cell + 1]);
    }

    area(cell, x, y) {
        const { start, points } = this.pieces;
        let sum = 0;
        for (let k = 4 * start[cell]; k < 4 * start[cell + 1]; k += 4) {
            const [a, b, c, d] = [points[k], points[k + 1], points[k + 2], points[k + 3]];
            sum += 0.5 * ((x[c] - x[a]) * (y[d] - y[b]) - (x[d] - x[b]) * (y[c] - y[a]));
        }
        return sum;
    }

    centre(cell, x, y) {
        const corners = this.corners(cell);
        let cx = 0,
            cy = 0;
        for (const point of corners) {
            cx += x[point] / corners.length;
            cy += y[point] / corners.length;
        }
        return [cx, cy];
    }

    judge() {
        const { x, y } = this.model,
            { start, points } = this.pieces,
            divided = new DividedCell(this.pieces, this.model);
        let least = Infinity,
            sum = 0;
        for (let cell = 0; cell < this.n; ++cell) {
            const begin = 4 * start[cell];
            let judged;
            if (start[cell + 1] - start[cell] > 1) {
                divided.judge(cell);
                judged = divided;
            } else {
                const corners = points[begin + 3] === points[begin + 2] ? 3 : 4;
                judged = this.judge_whole(points.subarray(begin, begin + corners), x, y);
            }
            const size = this.reference_area[cell],
                ratio = Math.min(judged.area, size) / Math.max(judged.area, size);
            this.quality[cell] = judged.smallest > 0 ? judged.quality * Math.sqrt(ratio) : 0;
            sum += this.quality[cell];
            least = Math.min(least, this.quality[cell]);
        }
        Object.assign(this, { min_quality: least, mean_quality: sum / this.n });
    }

    // Returns twice the area of the worst corner of a triangle or quadrilateral, the area and the skew quality.
    judge_whole(row, x, y) {
        const n = row.length;
        let smallest = Infinity,
            area = 0,
            skew = 0;
        for (let k = 0; k < n; ++k) {
            const a = row[(k + n - 1) % n],
                b = row[k],
                c = row[(k + 1) % n];
            const px = x[b] - x[a],
                py = y[b] - y[a],
                qx = x[c] - x[b],
                qy = y[c] - y[b],
                corner = px * qy - py * qx; // of a triangle: the same at all corners
            smallest = Math.min(smallest, corner);
            if (k === 0 || (n === 4 && k === 2)) area += 0.5 * corner;
            skew += n === 3 ? qx * qx + qy * qy : Math.sqrt((px * px + py * py) * (qx * qx + qy * qy)) / corner;
        }
        return { smallest, area, quality: n === 3 ? (4 * Math.sqrt(3) * area) / skew : 4 / skew };
    }
}
