"use strict";
// What the library says of the cells: their quality, and the extremes.

class Cells {
    // quality: of each cell, 0 if the cell is inverted. A report has no model.
    constructor(data, quality, model = null) {
        Object.assign(this, { data, quality, model, n: quality.length });
    }

    corners(cell) {
        const { cell_start, cell_points } = this.data;
        return cell_points.subarray(cell_start[cell], cell_start[cell + 1]);
    }

    // Returns the square root of the area of a cell, with the coordinates x, y.
    size(cell, x, y) {
        const [first, ...rest] = this.corners(cell),
            twice = (b, k) => (k === 0 ? 0 : twice_area(first, rest[k - 1], b, x, y));
        return Math.sqrt(Math.abs(rest.reduce((sum, b, k) => sum + twice(b, k), 0)) / 2);
    }

    // Returns the place of a mark on a cell.
    centre(cell, x, y) {
        const corners = [...this.corners(cell)],
            mean = (at) => corners.reduce((sum, point) => sum + at[point], 0) / corners.length;
        return [mean(x), mean(y)];
    }

    // Takes the reports of hm_assess. step is a fraction of the movement; limiting is the cell that limits it.
    judge({ step, quality }) {
        this.quality.set(this.model.qualities.view);
        Object.assign(this, { step: step.admissible, limiting: step.cell, inverted: quality.inverted });
        Object.assign(this, { min_quality: quality.minQuality, mean_quality: quality.meanQuality });
        this.worst = quality.minQualityCell;
    }
}
