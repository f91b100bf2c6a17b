"use strict";
// This painter draws cells in colour and lines of the mesh on a 2D canvas, for browsers without WebGL 2 or without a
// graphics processor. GlPainter has the same methods.

// A piece with one of these values belongs to an inverted cell, drawn above the others, or is not drawn.
const cell_value = { bad: -1, hidden: 2 };

// Returns the strength of lines that fade, from 0 to 1; pixels is the distance between the lines.
function line_strength(pixels) {
    return Math.min(Math.max((pixels - 1) / 6, 0), 1);
}

// Cells are filled pixel by pixel: a canvas takes ten times as long for many small paths. A pixel belongs to the
// triangle in which its centre lies, so triangles that share a side leave no gap, and one that has no centre of a pixel
// costs next to nothing.
class Raster {
    constructor(width, height) {
        this.image = new ImageData(width, height);
        this.pixels = new Uint32Array(this.image.data.buffer);
        Object.assign(this, { width, height });
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
            last = Math.min(Math.ceil(cy - 0.5), this.height);
        for (let row = Math.max(Math.ceil(ay - 0.5), 0); row < last; ++row) {
            const y = row + 0.5,
                one = ax + ((y - ay) * (cx - ax)) / (cy - ay),
                other = y < by ? ax + ((y - ay) * (bx - ax)) / (by - ay) : bx + ((y - by) * (cx - bx)) / (cy - by),
                end = row * width + Math.min(Math.ceil(Math.max(one, other) - 0.5), width);
            let pixel = row * width + Math.max(Math.ceil(Math.min(one, other) - 0.5), 0);
            for (; pixel < end; ++pixel) pixels[pixel] = colour;
        }
        return undefined;
    }
}

class CanvasPainter {
    // pieces holds four points for each piece; see Pieces.
    constructor(canvas, pieces) {
        this.canvas = canvas;
        this.pieces = pieces;
        // The processor draws this canvas: a browser that imitates a graphics processor would take seconds for a frame.
        this.context = canvas.getContext("2d", { willReadFrequently: true });
    }

    static style(colour) {
        return `rgba(${colour
            .slice(0, 3)
            .map((part) => Math.round(255 * part))
            .join()},${colour[3]})`;
    }

    begin(width, height, ratio, background) {
        this.canvas.width = Math.round(width * ratio);
        this.canvas.height = Math.round(height * ratio);
        Object.assign(this, { width, height, ratio, background });
        this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
        this.context.fillStyle = CanvasPainter.style([...background, 1]);
        this.context.fillRect(0, 0, width, height);
        this.context.lineWidth = 1 / ratio;
        this.raster = null;
    }

    // Takes the pixels of all points, in pairs.
    place(screen) {
        this.screen = screen;
    }

    // Fills each piece in the colour of its value, 0..1, or as cell_value says.
    fill_cells(values, scale, bad) {
        const colours = scale.pixels();
        this.fill((piece) => (values[piece] >= 0 && values[piece] <= 1 ? colours[Math.round(255 * values[piece])] : 0));
        if (!values.includes(cell_value.bad)) return;
        const red = pixel_of(...bad.map((part) => 255 * part));
        this.fill((piece) => (values[piece] === cell_value.bad ? red : 0));
    }

    // Fills each piece in the colour of the mean of its points' values.
    fill_points(values, scale) {
        const { pieces } = this,
            colours = scale.pixels();
        this.fill((piece) => {
            const k = 4 * piece;
            const sum = values[pieces[k]] + values[pieces[k + 1]] + values[pieces[k + 2]] + values[pieces[k + 3]];
            return colours[Math.round((255 / 4) * sum)];
        });
    }

    // Fills pieces; a piece of colour 0 is left out.
    fill(colour_of_piece) {
        const { pieces, canvas } = this,
            at = this.screen.map((pixel) => pixel * this.ratio);
        if (this.raster === null) {
            this.raster = new Raster(canvas.width, canvas.height);
            this.raster.pixels.fill(pixel_of(...this.background.map((part) => 255 * part)));
        }
        const { raster } = this;
        for (let piece = 0; 4 * piece < pieces.length; ++piece) {
            const colour = colour_of_piece(piece);
            if (colour === 0) continue;
            const a = 2 * pieces[4 * piece],
                b = 2 * pieces[4 * piece + 1],
                c = 2 * pieces[4 * piece + 2],
                d = 2 * pieces[4 * piece + 3];
            raster.triangle(at, a, b, c, colour);
            if (d !== c) raster.triangle(at, a, c, d, colour);
        }
        this.context.putImageData(this.raster.image, 0, 0);
    }

    // Draws edges, which are pairs of points with the distance to the next edge beside each; scale is in pixels per
    // unit of length. Lines that lie closer together than half a pixel are thinned; lines that fade hide no colours.
    lines({ pairs, spacing }, colour, scale, fade) {
        const levels = 4,
            paths = Array.from({ length: levels + 1 }, () => new Path2D());
        for (let i = 0; i < spacing.length; ++i) {
            const pixels = spacing[i] * scale;
            if ((i * 0.6180339887) % 1 > 2 * pixels) continue;
            const level = fade ? Math.round(levels * line_strength(pixels)) : levels;
            if (level > 0) this.line(paths[level], this.screen, 2 * pairs[2 * i], 2 * pairs[2 * i + 1]);
        }
        paths.forEach((path, level) => this.stroke(path, [...colour.slice(0, 3), (colour[3] * level) / levels]));
    }

    segments(positions, n, colour) {
        const path = new Path2D();
        for (let i = 0; i < n; ++i) this.line(path, positions, 4 * i, 4 * i + 2);
        this.stroke(path, colour);
    }

    line(path, positions, a, b) {
        const ax = positions[a],
            ay = positions[a + 1],
            bx = positions[b],
            by = positions[b + 1];
        if ((ax < 0 && bx < 0) || (ay < 0 && by < 0)) return;
        if ((ax > this.width && bx > this.width) || (ay > this.height && by > this.height)) return;
        path.moveTo(ax, ay);
        path.lineTo(bx, by);
    }

    stroke(path, colour) {
        this.context.strokeStyle = CanvasPainter.style(colour);
        this.context.stroke(path);
    }

    // Waits until everything is drawn.
    finish() {
        this.context.getImageData(0, 0, 1, 1);
    }
}
