"use strict";
// A raster fills triangles and draws lines pixel by pixel: a canvas takes ten times as long for many small paths. A
// pixel belongs to the triangle in which its centre lies, so that triangles with a common side leave no gap, and a
// triangle without the centre of a pixel costs next to nothing.

class Raster {
    constructor(width, height) {
        this.image = new ImageData(width, height);
        this.pixels = new Uint32Array(this.image.data.buffer);
        Object.assign(this, { width, height });
        this.set_colour([0, 0, 0, 1]);
    }

    // Fills a triangle. at holds x, y pairs; a, b, c are the places of three pairs, which are sorted from top to
    // bottom.
    triangle(at, a, b, c, colour) {
        if (at[a + 1] > at[b + 1]) return this.triangle(at, b, a, c, colour);
        if (at[b + 1] > at[c + 1]) return this.triangle(at, a, c, b, colour);
        const { pixels, width } = this,
            ax = at[a],
            ay = at[a + 1],
            bx = at[b],
            by = at[b + 1],
            cx = at[c],
            cy = at[c + 1],
            slope_ab = (bx - ax) / (by - ay), // x along each side changes by its slope from row to row
            slope_bc = (cx - bx) / (cy - by),
            slope_ac = (cx - ax) / (cy - ay),
            last = Math.min(Math.ceil(cy - 0.5), this.height);
        for (let row = Math.max(Math.ceil(ay - 0.5), 0); row < last; ++row) {
            const y = row + 0.5,
                one = ax + (y - ay) * slope_ac,
                other = y < by ? ax + (y - ay) * slope_ab : bx + (y - by) * slope_bc,
                end = row * width + Math.min(Math.ceil(Math.max(one, other) - 0.5), width);
            let pixel = row * width + Math.max(Math.ceil(Math.min(one, other) - 0.5), 0);
            for (; pixel < end; ++pixel) pixels[pixel] = colour;
        }
        return undefined;
    }

    // Sets the colour of lines: red, green, blue and strength, 0..1.
    set_colour([red, green, blue, strength]) {
        const pixel = pixel_of(255 * red, 255 * green, 255 * blue);
        this.red_and_blue = pixel & 0xff00ff;
        this.green = pixel & 0x00ff00;
        this.strength = strength;
    }

    // Mixes a pixel with the colour of lines; part is a whole number, 0..127.
    mix(pixel, part) {
        const { pixels } = this,
            red_and_blue = pixels[pixel] & 0xff00ff,
            green = pixels[pixel] & 0x00ff00;
        pixels[pixel] =
            0xff000000 |
            ((red_and_blue + (Math.imul(this.red_and_blue - red_and_blue, part) >> 7)) & 0xff00ff) |
            ((green + (Math.imul(this.green - green, part) >> 7)) & 0x00ff00);
    }

    // Draws a line of one pixel's width between two pairs of at.
    line(at, a, b, strength) {
        const { width, height } = this,
            ax = at[a],
            ay = at[a + 1],
            bx = at[b],
            by = at[b + 1];
        if ((ax < 0 && bx < 0) || (ay < 0 && by < 0)) return;
        if ((ax > width && bx > width) || (ay > height && by > height)) return;
        if (Math.abs(bx - ax) >= Math.abs(by - ay))
            this.flat_line(ax, ay, bx, by, strength, { columns: width, across: 1, rows: height, down: width });
        else this.flat_line(ay, ax, by, bx, strength, { columns: height, across: width, rows: width, down: 1 });
    }

    // Draws a line that is not steep; across and down are the distances of pixels to the next column and row, so that a
    // steep line is drawn with columns and rows exchanged. In each column whose centre the line passes, two pixels
    // share the line; so lines that follow each other leave no gap, and lines shorter than a pixel are as dense as
    // they should be.
    flat_line(ax, ay, bx, by, strength, { columns, across, rows, down }) {
        const slope = (by - ay) / (bx - ax),
            full = Math.round(127 * this.strength * strength),
            end = Math.min(Math.ceil(Math.max(ax, bx) - 0.5), columns);
        for (let column = Math.max(Math.ceil(Math.min(ax, bx) - 0.5), 0); column < end; ++column) {
            const y = ay + (column + 0.5 - ax) * slope - 0.5,
                row = Math.floor(y),
                second = Math.round(full * (y - row)),
                pixel = column * across + row * down;
            if (row >= 0 && row < rows) this.mix(pixel, full - second);
            if (row >= -1 && row < rows - 1) this.mix(pixel + down, second);
        }
    }
}
