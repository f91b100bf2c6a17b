"use strict";
// The part of the plane that a canvas shows. Pixels are computed in double precision, so that cells of 1e-8 can be
// looked at.

class Camera {
    // scale is in pixels per unit of length. If is_home is true, the whole body is shown, also after the window
    // changes.
    constructor() {
        Object.assign(this, { x: 0, y: 0, scale: 1, width: 1, height: 1, is_home: false });
    }

    pixel_x(x) {
        return this.width / 2 + (x - this.x) * this.scale;
    }
    pixel_y(y) {
        return this.height / 2 - (y - this.y) * this.scale;
    }
    plane_x(px) {
        return this.x + (px - this.width / 2) / this.scale;
    }
    plane_y(py) {
        return this.y - (py - this.height / 2) / this.scale;
    }

    resize(width, height) {
        Object.assign(this, { width, height });
    }

    // Shows a box of the plane; margin is the part of the canvas that stays free at each side.
    fit(box, margin) {
        this.is_home = false;
        this.x = (box[0] + box[2]) / 2;
        this.y = (box[1] + box[3]) / 2;
        const across = Math.max(box[2] - box[0], 1e-300),
            up = Math.max(box[3] - box[1], 1e-300),
            share = 1 - 2 * margin;
        this.scale = Math.min((share * this.width) / across, (share * this.height) / up);
    }

    zoom(factor, px = this.width / 2, py = this.height / 2) {
        const x = this.plane_x(px),
            y = this.plane_y(py);
        this.is_home = false;
        this.scale = Math.min(Math.max(this.scale * factor, 1e-12), 1e15);
        this.x += x - this.plane_x(px);
        this.y += y - this.plane_y(py);
    }

    pan(px, py) {
        this.is_home = false;
        this.x -= px / this.scale;
        this.y += py / this.scale;
    }

    // Writes the pixels of all points into `to`, in pairs.
    project(x, y, to) {
        const { scale } = this,
            left = this.width / 2 - this.x * scale,
            up = this.height / 2 + this.y * scale;
        const safe = Math.abs(left) < 1e9 && Math.abs(up) < 1e9; // otherwise the differences have to come first
        for (let k = 0; k < x.length; ++k) {
            to[2 * k] = safe ? left + x[k] * scale : this.pixel_x(x[k]);
            to[2 * k + 1] = safe ? up - y[k] * scale : this.pixel_y(y[k]);
        }
    }

    // Returns the largest round length that takes at most so many pixels.
    round_length(pixels) {
        const most = pixels / this.scale,
            power = 10 ** Math.floor(Math.log10(most));
        return power * [5, 2, 1].find((digit) => digit * power <= most);
    }
}

function box_of_points(x, y, points) {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    for (const k of points) {
        box[0] = Math.min(box[0], x[k]);
        box[1] = Math.min(box[1], y[k]);
        box[2] = Math.max(box[2], x[k]);
        box[3] = Math.max(box[3], y[k]);
    }
    return box;
}
