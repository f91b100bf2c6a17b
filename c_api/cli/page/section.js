"use strict";
// A section is the outline of one body: curves of the library, and the wall points on them. Design variables move its
// control points.

class Section {
    // chain: the wall points of the outline, in order.
    constructor({ chain, outline, name, model }) {
        Object.assign(this, { model, name, points: chain.points, curves: { curves: outline } });
        const [first, n] = outline,
            control = model.curves.curves.slice(first, first + n).flatMap(({ indices }) => [...indices]);
        this.control = [...new Set(control)];
        const curve_points = model.curve_points();
        this.trailing = chain.points.reduce((best, point, place) => {
            const { curve, u } = curve_points.get(point) ?? {};
            return curve === first && (best.u === undefined || u < best.u) ? { u, place } : best;
        }, { place: 0 }).place;
        this.frame = this.find_frame();
        this.start = this.now = this.measure(model.curves);
        this.thickening = this.find_thickening();
        const has = { thickness: this.thickening !== null, camber: this.can_be_cambered(), twist: true, flap: true };
        this.variables = Section.variables.filter(({ name: variable }) => has[variable]);
        this.moved_by = { values: "", moves: null };
    }

    // Returns the chord line: its origin at the leading edge, and (tx, ty) along the chord. An outline without ends has
    // the line between the two of its points that are farthest apart, the one on the left first.
    find_frame() {
        const { curves } = this.model,
            { line } = Section;
        try {
            return Section.frame_of(curves.measure(Section.stations, this.curves).places);
        } catch (error) {
            const [first] = this.curves.curves,
                points = curves.points(Curves.parameters(curves.curves[first], 6), { curve: first }),
                places = Array.from({ length: points.length / 2 }, (_, i) => points.subarray(2 * i, 2 * i + 2)),
                pairs = places.flatMap((a) => places.map((b) => line(a, b))),
                longest = pairs.reduce((one, other) => (other.chord > one.chord ? other : one)),
                { x, y, tx, ty, chord } = longest;
            this.curves.chord = [[x, y], [x + chord * tx, y + chord * ty]].sort((a, b) => a[0] - b[0]);
            return line(...this.curves.chord);
        }
    }
    static line(a, b) {
        const chord = Math.hypot(b[0] - a[0], b[1] - a[1]);
        return { x: a[0], y: a[1], tx: (b[0] - a[0]) / chord, ty: (b[1] - a[1]) / chord, chord };
    }
    // Returns the chord line through the places of its two stations.
    static frame_of([ax, ay, bx, by]) {
        return Section.line([1.5 * ax - 0.5 * bx, 1.5 * ay - 0.5 * by], [1.5 * bx - 0.5 * ax, 1.5 * by - 0.5 * ay]);
    }
    // Returns the place of a point along the chord and across it, in chords.
    in_chords({ x: x0, y: y0, tx, ty, chord }, x, y) {
        const [dx, dy] = [x - x0, y - y0];
        return [(dx * tx + dy * ty) / chord, (dy * tx - dx * ty) / chord];
    }

    // Thickness and camber are in chords; the chord and the area are in units of the mesh. What the library cannot
    // measure, as the leading edge of a polygon, is left out.
    measure(curves) {
        const measured = (...kinds) => {
            try {
                return curves.measure(kinds, this.curves);
            } catch (error) {
                return { values: kinds.map(() => NaN), places: kinds.flatMap(() => [NaN, NaN]) };
            }
        };
        const { values, places } = measured("chord", "maxThickness", "maxCamber", "area", "twist", ...Section.stations),
            [chord, thickness, camber, area, angle] = values,
            frame = Section.frame_of(places.slice(-4)),
            turn = this.start ? angle - this.start.angle : 0;
        return {
            chord,
            thickness: thickness / chord,
            thickest: this.in_chords(frame, places[2], places[3])[0],
            camber: camber / chord,
            area,
            angle,
            twist: -(turn - 360 * Math.round(turn / 360)),
            leading_edge_radius: measured("leadingEdgeRadius").values[0],
            trailing_edge_angle: measured("trailingEdgeAngle").values[0],
        };
    }
    judge(curves) {
        this.now = this.measure(curves);
    }

    // Returns the moved wall points as lines, from the trailing edge over the upper side and back.
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

    // Returns the distances of the control points of this section from its camber line, normal to the chord: pairs x, y
    // for all control points. null: this outline has no camber line.
    find_thickening() {
        const { curves } = this.model,
            { tx, ty, chord } = this.frame,
            places = this.control.map((i) =>
                this.in_chords(this.frame, curves.control[2 * i], curves.control[2 * i + 1])),
            stations = places.map(([along]) => ({ kind: "camber", station: Math.min(Math.max(along, 1e-3), 0.999) }));
        try {
            const camber = curves.measure(stations, this.curves).values,
                by = new Float64Array(2 * curves.nControl);
            this.control.forEach((i, k) => {
                const distance = chord * places[k][1] - camber[k];
                by.set([-distance * ty, distance * tx], 2 * i);
            });
            return by;
        } catch (error) {
            return null;
        }
    }

    // Returns whether the library can add camber to this outline.
    can_be_cambered() {
        try {
            return this.moved(this.model.curves, { camber: 1, twist: 0, flap: 0 }) !== null;
        } catch (error) {
            return false;
        }
    }
    described(scope) {
        const [first_curve, n_curves] = this.curves.curves,
            [[leading_x, leading_y], [trailing_x, trailing_y]] = this.curves.chord ?? [[0, 0], [0, 0]];
        return scope.struct("hm_section", { first_curve, n_curves, leading_x, leading_y, trailing_x, trailing_y });
    }

    // Returns the movement of all control points, [2*n_control], by values of the design variables: thickness, then
    // camber, flap and twist.
    moves(values) {
        const key = JSON.stringify(values);
        if (key === this.moved_by.values) return this.moved_by.moves;
        const { curves } = this.model,
            { thickness, ...others } = values,
            by = new Float64Array(2 * curves.nControl);
        if (thickness !== 0 && this.thickening !== null)
            this.thickening.forEach((unit, k) => (by[k] = (thickness / 100) * unit));
        if (Object.values(others).some((value) => value !== 0))
            this.moved(curves.moved(by), others).forEach((move, k) => (by[k] += move));
        this.moved_by = { values: key, moves: by };
        return by;
    }
    // The camber line is a parabola, [% of the chord]; the leading edge turns up, the flap down [degrees].
    moved(curves, { camber, twist, flap }) {
        const { library } = curves,
            { HM_LINEAR, HM_FLAP, HM_ROTATE, HM_NACA4 } = library.constants,
            { x, y, tx, ty, chord } = this.frame,
            at = (station) => ({ x: x + station * chord * tx, y: y + station * chord * ty });
        return library.with((scope) => {
            const peaks = scope.copied(Float64Array.of(0.5)),
                variables = scope.struct("hm_variables", { kind: HM_NACA4, n_upper: 1, peaks }),
                all = [
                    { movement: { kind: HM_LINEAR, variables }, values: [camber / 100, 0] },
                    { movement: { kind: HM_FLAP, ...at(Section.hinge) }, values: [-flap] },
                    { movement: { kind: HM_ROTATE, ...at(0.25) }, values: [-twist] },
                ].filter(({ values }) => values[0] !== 0),
                movements = scope.structs("hm_movement", all.map(({ movement }) => movement)),
                values = scope.copied(Float64Array.from(all.flatMap((one) => one.values))),
                move = scope.take(16 * curves.nControl),
                result = scope.struct("hm_section_move", { move }),
                [view, section] = [curves.describe(scope), this.described(scope)];
            scope.with_memory((memory) =>
                library.call("hm_move_section", view, section, all.length, movements, values, result, memory));
            return library.memory.numbers(move, 2 * curves.nControl).slice();
        });
    }
}
Section.stations = [0.25, 0.75].map((station) => ({ kind: "thickness", station })); // which tell where the chord is
Section.hinge = 0.7; // of the flap, in chords from the leading edge
Section.variables = [
    { name: "thickness", label: "Thickness", unit: "%", most: 60, step: 0.5 },
    { name: "camber", label: "Camber", unit: "% c", most: 6, step: 0.05 },
    { name: "twist", label: "Twist", unit: "°", most: 15, step: 0.1 },
    { name: "flap", label: "Flap", unit: "°", most: 20, step: 0.1 },
];
