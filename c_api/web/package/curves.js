// B-spline curves with common control points. They are arrays of JavaScript; a call copies them.
import { choice, number, pair, refuse, show, whole } from "./errors.js";
import { Owner } from "./library.js";

const CLOSED = { auto: "HM_CLOSED_AUTO", open: "HM_OPEN", tied: "HM_TIED", periodic: "HM_PERIODIC" };
const QUANTITIES = [
    "area", "centroidX", "centroidY", "momentXx", "momentYy", "momentXy", "chord", "thickness", "camber",
    "maxThickness", "maxCamber", "leadingEdgeRadius", "trailingEdgeAngle", "trailingEdgeGap", "minRadius",
    "curvatureVariation", "clearance", "twist", "minThickness", "distance",
];

/** Curves with common control points; index.d.ts describes the arguments. */
export class Curves extends Owner {
    constructor(control, curves, weights = null) {
        super();
        this.control = floats(control, "control");
        if (this.control.length % 2 !== 0) refuse("control must be pairs x, y of numbers.", "HM_BAD_CURVE");
        this.nControl = this.control.length / 2;
        this.weights = weights === null ? null : floats(weights, "weights");
        if (this.weights !== null && this.weights.length !== this.nControl) {
            refuse(`weights must have ${this.nControl} numbers, not ${this.weights.length}.`, "HM_BAD_CURVE");
        }
        this.curves = Array.isArray(curves) ? curves.map(curve) : refuse("curves must be an array.", "HM_BAD_CURVE");
        this.markers = [];
        this.fitReport = null;
        this.library.with((scope) => this.library.call("hm_curves_check", this.describe(scope)));
    }

    /** Writes hm_curves into a scope and returns the address. */
    describe(scope) {
        const curves = this.curves.map(({ degree, knots, indices }) => ({
            degree,
            n_indices: indices.length,
            indices: scope.copied(indices),
            knots: scope.copied(knots),
        }));
        return scope.struct("hm_curves", {
            n_control: this.nControl,
            control: scope.copied(this.control),
            weights: this.weights === null ? 0 : scope.copied(this.weights),
            n_curves: curves.length,
            curve: scope.structs("hm_curve", curves),
        });
    }

    /** Fits curves to the points of markers of a mesh, each connected piece by its own. */
    static fit(mesh, markers, options = {}) {
        const { library } = this;
        const names = Array.isArray(markers) ? markers : [markers];
        const numbers = mesh.open().numbers_of(names);
        return library.with((scope) => {
            const given = fit_options(scope, options, mesh.nPoints);
            const list = scope.integers(numbers, undefined, "markers");
            const report = scope.struct("hm_fit_report");
            const found = scope.object("hm_fit_marker", mesh.address, numbers.length, list, given, report);
            return this.found(found, library.layout.read("hm_fit_report", report), names);
        });
    }

    /** Fits curves to points in order. */
    static fitPoints(points, isLoop, options = {}) {
        const { library } = this;
        const length = (points?.view ?? points)?.length;
        if (!Number.isInteger(length) || length % 2 !== 0) {
            refuse(`points must be pairs x, y, x, y, ... of numbers, not ${show(points)}.`);
        }
        return library.with((scope) => {
            const n = length / 2, given = fit_options(scope, options, n);
            const view = scope.points(points, n, "points");
            const report = scope.struct("hm_fit_report");
            const found = scope.object("hm_fit", view, n, isLoop ? 1 : 0, given, report);
            return this.found(found, library.layout.read("hm_fit_report", report), []);
        });
    }

    static found(address, report, markers) {
        const curves = this.copied(address);
        curves.fitReport = report;
        curves.markers = markers;
        return curves;
    }

    // A copy of hm_curves of the library.
    static copied(address) {
        const { memory, layout } = this.library;
        const of_set = (name) => layout.get("hm_curves", address, name);
        const n = of_set("n_control"), first = of_set("index_base"), weights = of_set("weights");
        const curves = [];
        for (let k = 0; k < of_set("n_curves"); ++k) {
            const one = of_set("curve") + k * layout.size("hm_curve");
            const degree = layout.get("hm_curve", one, "degree"), count = layout.get("hm_curve", one, "n_indices");
            const indices = layout.get("hm_curve", one, "indices");
            curves.push({
                degree,
                knots: memory.numbers(layout.get("hm_curve", one, "knots"), count + degree + 1).slice(),
                indices: indices === 0 ? Int32Array.from({ length: count }, (_, i) => i)
                    : memory.integers(indices, count).map((one_index) => one_index - first),
            });
        }
        const control = memory.numbers(of_set("control"), 2 * n).slice();
        return new this(control, curves, weights === 0 ? null : memory.numbers(weights, n).slice());
    }

    // The curves that a call of the library gives: (..., out, array of curves, its capacity).
    static of_basis(call, n, ...values) {
        return this.library.with((scope) => {
            const out = scope.struct("hm_curves"), list = scope.structs("hm_curve", new Array(n).fill({}));
            this.library.call(call, ...values, out, list, n);
            return this.copied(out);
        });
    }

    /** Returns the curves with control points moved by `move`. */
    moved(move) {
        const step = floats(move, "move");
        if (step.length !== 2 * this.nControl) {
            refuse(`move must have ${2 * this.nControl} numbers, not ${step.length}.`);
        }
        const curves = new this.constructor(this.control.map((x, k) => x + step[k]), this.curves, this.weights);
        curves.markers = this.markers;
        return curves;
    }

    /** Returns points of a curve at parameters, or derivatives by the parameter: pairs x, y. */
    points(u, { curve: which = 0, derivative = 0 } = {}) {
        const parameters = floats(u, "u");
        whole(derivative, "derivative", 0, 5);
        return this.library.with((scope) => {
            const { memory } = this.library, view = this.describe(scope), xy = scope.take(96);
            const result = new Float64Array(2 * parameters.length);
            parameters.forEach((parameter, k) => {
                this.library.call("hm_curve_point", view, whole(which, "curve"), parameter, derivative, xy);
                result.set(memory.numbers(xy + 16 * derivative, 2), 2 * k);
            });
            return result;
        });
    }

    /** Returns the first and the last parameter of a curve. */
    range(which = 0) {
        const one = this.curves[which] ?? refuse(`There is no curve ${show(which)}.`);
        return [one.knots[one.degree], one.knots[one.indices.length]];
    }

    /** Returns the parameter of the nearest point of a curve, and the distance. */
    project(point, which = 0) {
        const [x, y] = pair(point, "point");
        return this.library.with((scope) => {
            const found = scope.take(16);
            this.library.call("hm_curve_project", this.describe(scope), whole(which, "curve"), x, y, found, found + 8);
            const [u, distance] = this.library.memory.numbers(found, 2);
            return { u, distance };
        });
    }

    /** Measures the section: { values, gradients, places }. */
    measure(quantities, { chord, curves } = {}) {
        const list = Array.isArray(quantities) ? quantities : [quantities];
        return this.library.with((scope) => {
            const n = list.length, view = this.describe(scope);
            const structs = scope.structs("hm_quantity", list.map((one) => quantity(scope, one)));
            const values = scope.take(8 * n), places = scope.take(16 * n);
            const gradients = scope.take(16 * n * this.nControl);
            this.library.call("hm_measure", view, section(scope, chord, curves), n, structs, values, places, gradients);
            const { memory } = this.library;
            return {
                values: memory.numbers(values, n).slice(),
                gradients: memory.numbers(gradients, 2 * n * this.nControl).slice(),
                places: memory.numbers(places, 2 * n).slice(),
            };
        });
    }

    /** Returns the movement with which a curve becomes another airfoil, and how near it comes. */
    refit(points, isLoop, { curve: which = 0, onChord = true } = {}) {
        const values = floats(points, "points"), n = values.length / 2;
        whole(n, "the number of points");
        return this.library.with((scope) => {
            const view = this.describe(scope), movement = scope.take(16 * this.nControl);
            const report = scope.struct("hm_refit_report"), at = scope.points(values, n, "points");
            whole(which, "curve");
            scope.with_memory((memory) => this.library.call("hm_refit", view, which, at, n, isLoop ? 1 : 0,
                onChord ? 1 : 0, movement, report, memory));
            return {
                move: this.library.memory.numbers(movement, 2 * this.nControl).slice(),
                report: this.library.layout.read("hm_refit_report", report),
            };
        });
    }

    /** Returns a gradient by the control points, smoothed along the curves over a length. */
    smooth(gradient, length) {
        return this.library.with((scope) => {
            const view = this.describe(scope), smoothed = scope.take(16 * this.nControl);
            const given = scope.numbers(gradient, 2 * this.nControl, "gradient");
            number(length, "length");
            scope.with_memory((memory) =>
                this.library.call("hm_smooth_gradient", view, length, given, smoothed, memory));
            return this.library.memory.numbers(smoothed, 2 * this.nControl).slice();
        });
    }
}

function floats(given, what) {
    const values = given?.view ?? given;
    const is_list = Array.isArray(values) || (ArrayBuffer.isView(values) && typeof values.length === "number");
    if (!is_list) refuse(`${what} must be numbers, not ${show(given)}.`);
    return Float64Array.from(values, (one) => number(one, what));
}

function curve(one) {
    if (typeof one !== "object" || one === null) refuse("A curve has degree, knots and indices.", "HM_BAD_CURVE");
    const degree = whole(one.degree, "degree", 1, 5), knots = floats(one.knots, "knots");
    const count = knots.length - degree - 1;
    const indices = one.indices === undefined ? Int32Array.from({ length: Math.max(0, count) }, (_, k) => k)
        : Int32Array.from(one.indices, (index) => whole(index, "an index"));
    if (indices.length !== count) {
        const needed = indices.length + degree + 1;
        refuse(`A curve of degree ${degree} with ${indices.length} indices needs ${needed} knots, not ${knots.length}.`,
            "HM_BAD_CURVE");
    }
    return { degree, knots, indices };
}

function fit_options(scope, options, n_points) {
    const { nControl = 20, degree = 3, closed = "auto", weights, smoothing = 0, tolerance = 0, begin = [0, 0],
        end = [0, 0] } = options;
    const [begin_x, begin_y] = pair(begin, "begin"), [end_x, end_y] = pair(end, "end");
    const details = { smoothing: number(smoothing, "smoothing"), tolerance: number(tolerance, "tolerance"),
        begin_x, begin_y, end_x, end_y };
    if (weights !== undefined) {
        details.weights = scope.numbers(weights, n_points, "weights");
        details.n_weights = n_points;
    }
    return scope.struct("hm_fit_options", {
        n_control: whole(nControl, "nControl"),
        degree: whole(degree, "degree"),
        closed: scope.library.constants[choice(CLOSED, closed, "closed")],
        details: scope.struct("hm_fit_details", details),
    });
}

function section(scope, chord, curves) {
    if (chord === undefined && curves === undefined) return 0;
    const members = {};
    if (curves !== undefined) [members.first_curve, members.n_curves] = pair(curves, "curves");
    if (chord !== undefined) {
        if (!Array.isArray(chord) || chord.length !== 2) refuse("chord must be two points: leading and trailing edge.");
        [members.leading_x, members.leading_y] = pair(chord[0], "the leading edge");
        [members.trailing_x, members.trailing_y] = pair(chord[1], "the trailing edge");
    }
    return scope.struct("hm_section", members);
}

// A name, or an object { kind, station, lastStation, polygon, sharpness, otherCurve, nOther }.
function quantity(scope, given) {
    const { kind, station = 0, lastStation = 0, polygon, sharpness = 0, otherCurve = 0, nOther = 0 } =
        typeof given === "string" ? { kind: given } : given ?? {};
    if (!QUANTITIES.includes(kind)) refuse(`The quantity must be one of ${QUANTITIES.join(", ")}, not ${show(kind)}.`);
    const name = kind.replace(/[A-Z]/g, (letter) => `_${letter}`).toUpperCase();
    const members = { kind: scope.library.constants[`HM_${name}`], station: number(station, "station"),
        last_station: number(lastStation, "lastStation"), sharpness: number(sharpness, "sharpness"),
        other_curve: whole(otherCurve, "otherCurve"), n_other: whole(nOther, "nOther") };
    if (polygon !== undefined) {
        const corners = floats(polygon, "polygon");
        members.polygon = scope.copied(corners);
        members.n_polygon = Math.floor(corners.length / 2);
    }
    return members;
}
