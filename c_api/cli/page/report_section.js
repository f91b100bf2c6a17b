"use strict";
// A section is a closed wall with a chord, a thickness, a camber and an area. Design variables move its control points.

class Section {
    // The edges are measured if curves are given.
    constructor(chain, data, model, curves = null) {
        this.model = model;
        this.curves = curves;
        this.first_curve = data.markers[chain.marker].first_curve;
        this.points = chain.points;
        const marker = data.markers[chain.marker];
        this.name = marker.name;
        this.control = Section.control_of(marker, data);
        this.find_ends();
        this.start = this.measure(model.x0, model.y0);
        if (curves !== null) Object.assign(this.start, curves.edges(this.first_curve));
        this.now = this.start;
        this.frame = this.chord_frame(model.x0, model.y0);
    }

    static control_of(marker, data) {
        const control = new Set();
        if (marker.kind !== "curve") return [];
        for (const curve of data.curves.slice(marker.first_curve, marker.first_curve + marker.n_curves)) {
            for (const index of curve.indices) control.add(index);
        }
        return [...control];
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

    // Thickness and camber are in chords; the chord and the area are in units of the mesh.
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
        const camber_line = one.map((height, k) => (Number.isNaN(height + other[k]) ? 0 : (height + other[k]) / 2));
        let thickness = 0,
            thickest = 0,
            camber = 0;
        for (let k = 0; k <= stations; ++k) {
            const height = Math.abs(one[k] - other[k]);
            if (height > thickness) {
                thickness = height;
                thickest = k / stations;
            }
            if (Math.abs(camber_line[k]) > Math.abs(camber)) camber = camber_line[k];
        }
        const twist =
            (Math.atan2(
                this.frame ? frame.ty * this.frame.tx - frame.tx * this.frame.ty : 0,
                this.frame ? frame.tx * this.frame.tx + frame.ty * this.frame.ty : 1,
            ) *
                -180) /
            Math.PI;
        return { chord: frame.chord, thickness, thickest, camber, area: Math.abs(twice_area) / 2, twist, camber_line };
    }

    judge() {
        this.now = this.measure(this.model.x, this.model.y);
        if (this.curves !== null) Object.assign(this.now, this.curves.edges(this.first_curve));
    }

    // Returns the moved points as lines, from the trailing edge over the upper side and back.
    text() {
        const { x, y } = this.model,
            n = this.points.length,
            lines = [this.name];
        for (let i = 0; i <= n; ++i) {
            const k = this.points[(this.trailing + n * n - i) % n];
            lines.push(`${x[k]} ${y[k]}`);
        }
        return lines.join("\n") + "\n";
    }

    // Returns the movement of a control point at x, y by a value of a design variable.
    moved_by(name, value, x, y) {
        const { frame } = this,
            [along, across] = this.in_chords(frame, x, y);
        const line = this.start.camber_line,
            clamped = Math.min(Math.max(along, 0), 1);
        const in_plane = (dt, dn) => [
            (dt * frame.tx - dn * frame.ty) * frame.chord,
            (dt * frame.ty + dn * frame.tx) * frame.chord,
        ];
        const turned = (hinge, height, degrees) => {
            // a positive angle turns the leading edge up, or the flap down
            const c = Math.cos((degrees * Math.PI) / 180) - 1,
                s = Math.sin((degrees * Math.PI) / 180);
            const dt = along - hinge,
                dn = across - height;
            return in_plane(c * dt + s * dn, c * dn - s * dt);
        };
        switch (name) {
            case "thickness":
                return in_plane(0, (value / 100) * (across - line[Math.round(clamped * (line.length - 1))]));
            case "camber":
                return in_plane(0, (value / 100) * 4 * clamped * (1 - clamped));
            case "twist":
                return turned(0.25, 0, value);
            default:
                return along > Section.hinge ? turned(Section.hinge, 0, value) : [0, 0];
        }
    }
}
Section.hinge = 0.7; // of the flap, in chords from the leading edge
Section.variables = [
    { name: "thickness", label: "Thickness", unit: "%", most: 60, step: 0.5 },
    { name: "camber", label: "Camber", unit: "% c", most: 6, step: 0.05 },
    { name: "twist", label: "Twist", unit: "°", most: 15, step: 0.1 },
    { name: "flap", label: "Flap", unit: "°", most: 20, step: 0.1 },
];
