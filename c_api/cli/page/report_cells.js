"use strict";
// The cells are judged with the formulas of hm_assess: inverted cells, the admissible step in closed form, and
// size-skew quality. DividedCell judges cells that are divided (see polygons.js).

// Returns the smallest s > 0 with c + b s + a s^2 = 0, where c > 0, without cancellation; infinite if there is none.
function smallest_positive_root(a, b, c) {
    if (!Number.isFinite(a + b)) return 0;
    if (a >= 0 && b >= 0) return Infinity;
    if (a === 0) return -c / b;
    const discriminant = b * b - 4 * a * c;
    if (discriminant < -4 * Number.EPSILON * b * b) return Infinity;
    const root = Math.sqrt(Math.max(discriminant, 0));
    if (b <= 0) return (2 * c) / (root - b);
    return a < 0 ? -(b + root) / (2 * a) : Infinity;
}

class Cells {
    constructor(data, model) {
        this.model = model;
        this.n = data.cell.length;
        this.data = data;
        this.pieces = data.pieces;
        this.quality = new Float64Array(this.n); // of each cell; 0 if the cell is inverted
        this.inverted = 0;
        this.step = Infinity; // as a fraction of the movement
        this.limiting = -1; // the cell that limits the step
        this.min_quality = this.mean_quality = 1;
        this.worst = -1;
        this.reference_area = new Float64Array(this.n);
        for (let cell = 0; cell < this.n; ++cell) this.reference_area[cell] = this.area(cell, model.x0, model.y0);
        this.sides = new Float64Array(16); // x, y of the sides of one cell, then x, y of their changes
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
        const { x0, y0, dx, dy } = this.model,
            { pieces, sides } = this,
            { start, points } = pieces,
            divided = new DividedCell(pieces, this.model);
        let inverted = 0,
            step = Infinity,
            limiting = -1,
            least = Infinity,
            worst = -1,
            sum = 0;
        for (let cell = 0; cell < this.n; ++cell) {
            const begin = 4 * start[cell],
                is_divided = start[cell + 1] - start[cell] > 1,
                corners = is_divided ? 0 : points[begin + 3] === points[begin + 2] ? 3 : 4;
            if (is_divided) {
                divided.judge(cell, step);
                if (divided.step < step) {
                    step = divided.step;
                    limiting = cell;
                }
            }
            for (let k = 0; k < corners; ++k) {
                const a = points[begin + k],
                    b = points[begin + (k + 1 === corners ? 0 : k + 1)];
                sides[k] = x0[b] - x0[a];
                sides[4 + k] = y0[b] - y0[a];
                sides[8 + k] = dx[b] - dx[a];
                sides[12 + k] = dy[b] - dy[a];
            }
            // The area at a corner is (area + slope s + curvature s^2) / 2; all corners of a triangle have the same
            // area.
            let smallest = Infinity,
                first_area = 0,
                third_area = 0,
                skew = 0;
            for (let k = 0; k < corners; ++k) {
                const after = k,
                    before = k === 0 ? corners - 1 : k - 1;
                const ux = sides[before],
                    uy = sides[4 + before],
                    vx = sides[after],
                    vy = sides[4 + after];
                const mx = sides[8 + before],
                    my = sides[12 + before],
                    nx = sides[8 + after],
                    ny = sides[12 + after];
                const area = ux * vy - uy * vx,
                    curvature = mx * ny - my * nx;
                const slope = ux * ny - uy * nx + mx * vy - my * vx;
                // Most corners cannot lose their area before the present limit.
                const known = k > 0 && corners === 3;
                if (
                    !known &&
                    (step === Infinity || area + step * (Math.min(slope, 0) + step * Math.min(curvature, 0)) <= 0)
                ) {
                    const root = smallest_positive_root(curvature, slope, area);
                    if (root < step) {
                        step = root;
                        limiting = cell;
                    }
                }
                const px = ux + mx,
                    py = uy + my,
                    qx = vx + nx,
                    qy = vy + ny,
                    now = px * qy - py * qx;
                smallest = Math.min(smallest, now);
                if (k === 0) first_area = now;
                if (k === 2) third_area = now;
                if (corners === 3) {
                    skew += qx * qx + qy * qy;
                } else {
                    skew += Math.sqrt((px * px + py * py) * (qx * qx + qy * qy)) / now;
                }
            }
            if (is_divided) smallest = divided.smallest;
            let quality = 0;
            if (smallest > 0) {
                let cell_area = 0.5 * (corners === 3 ? first_area : first_area + third_area);
                const size = this.reference_area[cell];
                quality = corners === 3 ? (2 * 1.7320508075688772 * first_area) / skew : 4 / skew;
                if (is_divided) {
                    cell_area = divided.area;
                    quality = divided.quality;
                }
                quality *= Math.sqrt(Math.min(cell_area, size) / Math.max(cell_area, size));
            } else {
                ++inverted;
            }
            this.quality[cell] = quality;
            sum += quality;
            if (quality < least) {
                least = quality;
                worst = cell;
            }
        }
        Object.assign(this, { inverted, step, limiting, worst, min_quality: least, mean_quality: sum / this.n });
    }
}
