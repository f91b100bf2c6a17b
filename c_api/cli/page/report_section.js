"use strict";
// A section is a closed wall with a chord, a thickness, a camber and an area.

class Section {
    constructor(chain, data, model) {
        this.model = model;
        this.points = chain.points;
        this.name = data.markers[chain.marker].name;
        this.find_ends();
        this.start = this.measure(model.x0, model.y0);
        this.now = this.measure(model.x, model.y);
    }

    // Finds the two points farthest apart; round the trailing edge the section is thinner than round the leading edge.
    find_ends() {
        const { x0: x, y0: y } = this.model,
            n = this.points.length,
            distance = (i, j) =>
                Math.hypot(x[this.points[i]] - x[this.points[j]], y[this.points[i]] - y[this.points[j]]);
        let ends = [0, 0],
            most = 0;
        for (let i = 0; i < n; ++i) {
            for (let j = 0; j < i; ++j) {
                if (distance(i, j) <= most) continue;
                most = distance(i, j);
                ends = [i, j];
            }
        }
        // The width of the part of the section within a twentieth of the chord from an end.
        const width = (end) => {
            const near = [...this.points.keys()].filter((i) => distance(i, end) < most / 20);
            let widest = 0;
            for (const i of near) for (const j of near) widest = Math.max(widest, distance(i, j));
            return near.length > 2 ? Math.min(widest, this.spread(near, ends)) : Infinity;
        };
        const [a, b] = ends;
        [this.leading, this.trailing] = width(a) < width(b) ? [b, a] : [a, b];
    }

    spread(places, ends) {
        const { x0: x, y0: y } = this.model,
            a = this.points[ends[0]],
            b = this.points[ends[1]];
        const across = places.map(
            (i) => (x[b] - x[a]) * (y[this.points[i]] - y[a]) - (y[b] - y[a]) * (x[this.points[i]] - x[a]),
        );
        return (Math.max(...across) - Math.min(...across)) / Math.hypot(x[b] - x[a], y[b] - y[a]);
    }

    // Returns a frame with its origin at the leading edge and (tx, ty) along the chord.
    chord_frame(x, y) {
        const a = this.points[this.leading],
            b = this.points[this.trailing];
        const chord = Math.hypot(x[b] - x[a], y[b] - y[a]);
        return { x: x[a], y: y[a], tx: (x[b] - x[a]) / chord, ty: (y[b] - y[a]) / chord, chord };
    }

    // Returns the coordinates along the chord and across it, in chords.
    in_chords(frame, x, y) {
        const dx = x - frame.x,
            dy = y - frame.y;
        return [(dx * frame.tx + dy * frame.ty) / frame.chord, (dy * frame.tx - dx * frame.ty) / frame.chord];
    }

    // Returns the thickness and the camber, in chords, and the area in units of the mesh.
    measure(x, y) {
        const frame = this.chord_frame(x, y),
            n = this.points.length,
            stations = 200;
        let twice_area = 0;
        for (let i = 0; i < n; ++i) {
            const a = this.points[i],
                b = this.points[(i + 1) % n];
            twice_area += x[a] * y[b] - x[b] * y[a];
        }
        // The heights of one side of the section at the stations.
        const side = (from, to) => {
            const heights = new Float64Array(stations + 1).fill(NaN);
            for (let i = from; i !== to; i = (i + 1) % n) {
                const a = this.in_chords(frame, x[this.points[i]], y[this.points[i]]);
                const b = this.in_chords(frame, x[this.points[(i + 1) % n]], y[this.points[(i + 1) % n]]);
                const low = Math.max(0, Math.ceil(stations * Math.min(a[0], b[0])));
                const high = Math.min(stations, Math.floor(stations * Math.max(a[0], b[0])));
                for (let k = low; k <= high; ++k) {
                    const t = a[0] === b[0] ? 0 : (k / stations - a[0]) / (b[0] - a[0]);
                    heights[k] = a[1] + t * (b[1] - a[1]);
                }
            }
            return heights;
        };
        const one = side(this.leading, this.trailing),
            other = side(this.trailing, this.leading);
        let thickness = 0,
            camber = 0;
        for (let k = 0; k <= stations; ++k) {
            if (Number.isNaN(one[k] + other[k])) continue;
            const middle = (one[k] + other[k]) / 2;
            thickness = Math.max(thickness, Math.abs(one[k] - other[k]));
            if (Math.abs(middle) > Math.abs(camber)) camber = middle;
        }
        return { thickness, camber, area: Math.abs(twice_area) / 2 };
    }
}
