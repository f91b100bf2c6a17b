"use strict";
// This painter draws cells in colour and lines of the mesh on a 2D canvas, for browsers without WebGL 2 or without a
// graphics processor. GlPainter has the same methods.

// A piece with one of these values belongs to an inverted cell, drawn above the others, or is not drawn.
const cell_value = { bad: -1, hidden: 2 };

// Returns the strength of lines that fade, from 0 to 1; pixels is the distance between the lines.
function line_strength(pixels) {
    return Math.min(Math.max((pixels - 1) / 6, 0), 1);
}

class CanvasPainter {
    // pieces holds four points for each piece; see Pieces.
    constructor(canvas, pieces) {
        this.canvas = canvas;
        this.pieces = pieces;
        // The processor draws this canvas: a browser that imitates a graphics processor would take seconds for a frame.
        this.context = canvas.getContext("2d", { willReadFrequently: true });
        this.raster = null;
    }

    begin(width, height, ratio, background) {
        const { canvas, context } = this,
            across = Math.round(width * ratio),
            up = Math.round(height * ratio);
        if (canvas.width !== across || canvas.height !== up) [canvas.width, canvas.height] = [across, up];
        context.setTransform(ratio, 0, 0, ratio, 0, 0);
        if (this.raster === null || this.raster.width !== across || this.raster.height !== up)
            this.raster = new Raster(Math.max(across, 1), Math.max(up, 1));
        this.raster.pixels.fill(pixel_of(...background.map((part) => 255 * part)));
        this.ratio = ratio;
    }

    // Takes the pixels of all points, in pairs.
    place(screen) {
        if (!this.at || this.at.length !== screen.length) this.at = new Float32Array(screen.length);
        for (let k = 0; k < screen.length; ++k) this.at[k] = screen[k] * this.ratio;
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

    // Fills the pieces that contain the centre of a pixel, as far as their box tells; a piece of colour 0 is left out.
    fill(colour_of_piece) {
        const { pieces, at, raster } = this,
            { width, height } = raster;
        for (let k = 0; k < pieces.length; k += 4) {
            const a = 2 * pieces[k],
                b = 2 * pieces[k + 1],
                c = 2 * pieces[k + 2],
                d = 2 * pieces[k + 3],
                left = Math.min(at[a], at[b], at[c], at[d]),
                right = Math.max(at[a], at[b], at[c], at[d]);
            if (right < 0.5 || left > width - 0.5 || Math.ceil(left - 0.5) > right - 0.5) continue;
            const top = Math.min(at[a + 1], at[b + 1], at[c + 1], at[d + 1]),
                bottom = Math.max(at[a + 1], at[b + 1], at[c + 1], at[d + 1]);
            if (bottom < 0.5 || top > height - 0.5 || Math.ceil(top - 0.5) > bottom - 0.5) continue;
            const colour = colour_of_piece(k >> 2);
            if (colour === 0) continue;
            raster.triangle(at, a, b, c, colour);
            if (d !== c) raster.triangle(at, a, c, d, colour);
        }
    }

    // Draws edges (see edges_of), with scale in pixels per unit of length. Lines that fade hide no colours.
    lines({ pairs, spacing, least_scale }, colour, scale, fade) {
        const { at, raster } = this;
        raster.set_colour(colour);
        for (let i = 0; i < spacing.length && least_scale[i] <= 2 * scale; ++i) {
            if (least_scale[i] > scale) continue;
            const strength = fade ? line_strength(spacing[i] * scale) : 1;
            if (strength > 0) raster.line(at, 2 * pairs[2 * i], 2 * pairs[2 * i + 1], strength);
        }
    }

    // Draws n segments between pixels, four numbers for each.
    segments(positions, n, colour) {
        const { raster, ratio } = this,
            at = positions.subarray(0, 4 * n).map((pixel) => pixel * ratio);
        raster.set_colour(colour);
        for (let i = 0; i < n; ++i) raster.line(at, 4 * i, 4 * i + 2, 1);
    }

    // Ends a picture; afterwards the context can draw more.
    end() {
        this.context.putImageData(this.raster.image, 0, 0);
    }

    // Waits until everything is drawn.
    finish() {
        this.context.getImageData(0, 0, 1, 1);
    }
}
