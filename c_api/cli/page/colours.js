"use strict";
// Colours are arrays of parts 0..1. Variables of page.css hold the colours of the light and of the dark page.

function colour_of(name) {
    const text = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    const value = parseInt(text.slice(1), 16);
    return [((value >> 16) & 255) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}

function style_of(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

// Returns three bytes as a pixel, red in the lowest byte.
function pixel_of(red, green, blue) {
    return ((255 << 24) | (Math.round(blue) << 16) | (Math.round(green) << 8) | Math.round(red)) >>> 0;
}

// A scale from 0 to 1 interpolates between equally spaced colours "#rrggbb"; at(t) returns three bytes.
class Scale {
    constructor(colours) {
        this.table = new Uint8Array(3 * 256);
        const anchors = colours.map((text) => [1, 3, 5].map((begin) => parseInt(text.slice(begin, begin + 2), 16)));
        for (let i = 0; i < 256; ++i) {
            const position = (i / 255) * (anchors.length - 1),
                k = Math.min(Math.floor(position), anchors.length - 2);
            for (let part = 0; part < 3; ++part) {
                this.table[3 * i + part] =
                    anchors[k][part] + (position - k) * (anchors[k + 1][part] - anchors[k][part]);
            }
        }
    }

    at(t) {
        const i = 3 * Math.round(255 * Math.min(Math.max(t, 0), 1));
        return this.table.subarray(i, i + 3);
    }

    // Returns the 256 colours as pixels.
    pixels() {
        if (!this.pixel_table) {
            const { table } = this;
            this.pixel_table = Uint32Array.from({ length: 256 }, (_, i) =>
                pixel_of(...table.subarray(3 * i, 3 * i + 3)));
        }
        return this.pixel_table;
    }

    css(t) {
        return `rgb(${this.at(t).join()})`;
    }
}

// Poor cells are strong on a light and on a dark page, and good cells are quiet. The scales suit colour-blind readers.
const scales = {
    light: {
        good: new Scale(["#5b1a72", "#a8327d", "#e2695a", "#f5b35f", "#f7e3b4", "#eef4f2"]),
        function: new Scale(["#f4f8fb", "#c6e0ec", "#83bfd6", "#3f93b8", "#1d6391", "#143a63"]),
        change: new Scale(["#1f5fbf", "#7fb0e8", "#eef1f4", "#f3b27a", "#c2521a"]),
    },
    dark: {
        good: new Scale(["#fff3c4", "#fdc267", "#f0725c", "#b03a7e", "#4b2a66", "#1d2733"]),
        function: new Scale(["#16202b", "#17405a", "#1f6c86", "#3fa0a4", "#8fd0b0", "#eef7cf"]),
        change: new Scale(["#6fb3ff", "#2f659f", "#22303d", "#a3602f", "#ffb067"]),
    },
};
