"use strict";
// Charts are curves and histograms with axes, as SVG elements, below a title and a link to the numbers as a file.

// Returns about so many round numbers between low and high.
function ticks(low, high, about) {
    const rough = (high - low) / about,
        power = 10 ** Math.floor(Math.log10(rough));
    const distance = power * [1, 2, 5, 10].find((digit) => digit * power >= rough),
        list = [];
    for (let i = Math.ceil(low / distance - 1e-9); i * distance <= high + 1e-9 * distance; ++i) list.push(i * distance);
    return list;
}

// Returns rows of numbers and texts as lines; a text with a comma or a quotation mark stands between quotation marks.
function csv(rows) {
    const field = (value) => (/[",\n]/.test(value) ? `"${value.replaceAll('"', '""')}"` : String(value));
    return rows.map((row) => row.map(field).join() + "\n").join("");
}

class Chart {
    // width and height are in pixels, so that letters keep their size on small screens.
    constructor({ x, y, x_name, width, height = 220 }) {
        Object.assign(this, { x, y, width, height, left: 48, right: 14, top: 8, bottom: 40 });
        this.parts = [];
        const base = height - this.bottom;
        for (const at of ticks(x[0], x[1], Math.min(width / 90, 10))) {
            this.line(this.px(at), this.top, this.px(at), base, "var(--soft)");
            this.text(brief(at), this.px(at), base + 17, "middle");
        }
        for (const at of ticks(y[0], y[1], 5)) {
            this.line(this.left, this.py(at), width - this.right, this.py(at), "var(--edge)");
            this.text(brief(at), this.left - 8, this.py(at) + 4, "end");
        }
        this.text(x_name, (this.left + width - this.right) / 2, height - 5, "middle");
    }

    px(x) {
        return this.left + ((x - this.x[0]) / (this.x[1] - this.x[0])) * (this.width - this.left - this.right);
    }
    py(y) {
        return (
            this.height -
            this.bottom -
            ((y - this.y[0]) / (this.y[1] - this.y[0])) * (this.height - this.top - this.bottom)
        );
    }

    line(ax, ay, bx, by, colour) {
        this.parts.push(
            `<line x1="${ax.toFixed(1)}" y1="${ay.toFixed(1)}" x2="${bx.toFixed(1)}" y2="${by.toFixed(1)}" stroke="${colour}"/>`,
        );
    }
    text(text, x, y, anchor) {
        this.parts.push(`<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" text-anchor="${anchor}">${text}</text>`);
    }

    curve(points, colour) {
        const path = points.map(([x, y]) => `${this.px(x).toFixed(1)},${this.py(y).toFixed(1)}`).join(" ");
        this.parts.push(`<polyline points="${path}" fill="none" stroke="${colour}" stroke-width="2"/>`);
    }

    // Draws the counts of equal bins over the x axis. A bar begins at the fraction `begin` of its bin and is `share` of
    // the bin wide.
    bars(counts, colour, begin, share) {
        const bin = (this.x[1] - this.x[0]) / counts.length;
        counts.forEach((count, i) => {
            const x = this.px(this.x[0] + (i + begin) * bin),
                width = this.px(bin) - this.px(0),
                y = this.py(count);
            if (count === 0) return;
            this.parts.push(
                `<rect x="${x.toFixed(1)}" y="${y.toFixed(1)}" width="${(share * width).toFixed(1)}" ` +
                    `height="${(this.height - this.bottom - y).toFixed(1)}" fill="${colour}" stroke="none"/>`,
            );
        });
    }

    svg() {
        return `<svg viewBox="0 0 ${this.width} ${this.height}">${this.parts.join("")}</svg>`;
    }

    // columns are the names of the numbers in each row; file is the name of the table without ".csv".
    show_in(box, name, file, columns, rows) {
        const title = document.createElement("h3"),
            link = document.createElement("a"),
            head = document.createElement("div");
        title.textContent = name;
        link.textContent = "CSV";
        link.title = "The numbers of this chart as a table";
        link.download = file + ".csv";
        link.href = "data:text/csv;charset=utf-8," + encodeURIComponent(csv([columns, ...rows]));
        head.className = "row";
        head.append(title, link);
        box.innerHTML = this.svg();
        box.prepend(head);
    }
}
