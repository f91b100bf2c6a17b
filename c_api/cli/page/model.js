"use strict";
// The mesh in the memory of the library: X = X0 + sum_i F_i dP_i, and what the library says of it.

class Model {
    // classes: those of the package (c_api/web).
    constructor(data, classes) {
        const n = data.x.length;
        Object.assign(this, { n, classes, x0: data.x, y0: data.y, x: data.x.slice(), y: data.y.slice() });
        this.dx = new Float64Array(n);
        this.dy = new Float64Array(n);
        this.n_cells = data.cell_start.length - 1;
        this.mesh = new classes.Mesh(Model.pairs(data.x, data.y), Model.cells(data), Model.boundary(data));
        this.curves = data.n_control > 0 ? new classes.Curves(data.control, data.curves, data.weights) : null;
        this.morph = this.solved(data);
        this.n_functions = this.morph.functions;
        this.slips = data.conditions.some(({ kind }) => kind === "slip");
        this.at = new classes.Numbers(2 * n); // x, y of the moved points
        this.by = new classes.Numbers(2 * n); // their displacements
        this.start = new classes.Numbers(2 * n); // x, y before anything moves
        for (const numbers of [this.start, this.at]) numbers.view.set(this.mesh.points);
        this.qualities = new classes.Numbers(this.n_cells);
        this.outlines = outlines_of(data.curves);
    }

    static pairs(x, y) {
        const pairs = new Float64Array(2 * x.length);
        for (let k = 0; k < x.length; ++k) [pairs[2 * k], pairs[2 * k + 1]] = [x[k], y[k]];
        return pairs;
    }
    // Cells of one shape take the least time.
    static cells({ cell_start: start, cell_points: points, has_polygons: polygons }) {
        const all = (size) => !polygons && start.every((begin, k) => begin === size * k);
        return all(3) ? { triangles: points } : all(4) ? { quads: points } : { start, points, polygons };
    }
    static boundary({ markers, face_markers, face_points }) {
        const edges = markers.map(() => []);
        face_markers.forEach((marker, face) => edges[marker].push(face_points[2 * face], face_points[2 * face + 1]));
        return new Map(edges.map((list, marker) => [marker, { edges: Int32Array.from(list) }]));
    }

    solved(data) {
        const { classes } = this;
        if (data.basis_file !== "") return classes.Morph.load(decode_base64(data.basis_file, Uint8Array), this.mesh);
        const along = data.along.map((set) => new classes.Curves(set.control, set.curves, set.weights));
        const conditions = data.conditions.map((one) => {
            const { kind } = one, condition = { kind };
            if (kind === "curve") condition.curves = [one.first_curve, one.n_curves];
            if (kind === "rigid") condition.body = one.body;
            if (["rigid", "rotation"].includes(kind)) condition.centre = [one.x, one.y];
            if (["periodic", "rotation", "interface"].includes(kind)) condition.partner = one.partner;
            if (one.is_piece) condition.near = [one.near_x, one.near_y];
            if (one.along >= 0) condition.along = along[one.along];
            return [one.marker, condition];
        });
        return new classes.Morph(this.mesh, this.curves, conditions, {
            operator: ["conformal", "laplace", "weighted"][data.operator_kind],
            exponent: data.exponent,
            offsetCorrection: data.offset_correction,
        });
    }

    // Moves the mesh, always from the start; moves [2*functions] is the array that hm_morph takes.
    move(moves) {
        this.morph.displacement(moves, { out: this.by });
        this.take_displacements();
        if (!this.slips) return;
        const before = this.at.view.slice();
        this.morph.slip(this.at, { out: this.at });
        const at = this.at.view, by = this.by.view, start = this.start.view;
        for (let i = 0; i < at.length; ++i) if (at[i] !== before[i]) by[i] = at[i] - start[i];
        this.take_displacements();
    }
    // Moves the mesh to given places x, y, x, y, ...
    move_to(places) {
        const by = this.by.view, start = this.start.view;
        for (let i = 0; i < by.length; ++i) by[i] = places[i] - start[i];
        this.take_displacements();
        this.at.view.set(places);
        for (let k = 0; k < this.n; ++k) [this.x[k], this.y[k]] = [places[2 * k], places[2 * k + 1]];
    }
    // Moves the mesh by given displacements x, y, x, y, ...
    move_by(displacements) {
        this.by.view.set(displacements);
        this.take_displacements();
    }
    take_displacements() {
        const { n, x0, y0, x, y, dx, dy } = this, by = this.by.view, at = this.at.view;
        for (let k = 0; k < n; ++k) {
            dx[k] = by[2 * k];
            dy[k] = by[2 * k + 1];
            at[2 * k] = x[k] = x0[k] + dx[k];
            at[2 * k + 1] = y[k] = y0[k] + dy[k];
        }
    }

    // Returns what hm_assess says of the present movement: { step, quality }.
    assess() {
        return this.morph.assess(this.by, { cells: this.qualities });
    }

    // Calls the library: Numbers stand for points x, y, x, y, ..., which may be null.
    call(name, ...values) {
        const { library } = this.mesh;
        return library.with((scope) => {
            const given = values.map((value) =>
                value instanceof this.classes.Numbers ? scope.points(value, this.n, name) : value);
            return library.call(name, ...given);
        });
    }

    // Returns |F| at all points: by how much the movement (1, 0) of a function displaces them.
    size_of_function(i) {
        const moves = new Float64Array(2 * this.n_functions);
        moves[2 * i] = 1;
        const pairs = this.morph.displacement(moves);
        return Float64Array.from({ length: this.n }, (_, k) => Math.hypot(pairs[2 * k], pairs[2 * k + 1]));
    }

    // Returns the mesh points of curves, with the curve and the parameter of each: Map of {curve, u}.
    curve_points() {
        const { library } = this.mesh, { layout, memory } = library, found = new Map();
        library.with((scope) => {
            const info = scope.struct("hm_basis_info");
            library.call("hm_basis_info_get", this.morph.basis.address, info);
            const member = (name) => layout.get("hm_basis_info", info, name), n = member("curve_points");
            const points = memory.integers(member("curve_point"), n),
                curves = memory.integers(member("point_curve"), n),
                parameters = memory.numbers(member("point_u"), n);
            for (let k = 0; k < n; ++k) {
                if (curves[k] < member("curves")) found.set(points[k], { curve: curves[k], u: parameters[k] });
            }
        });
        return found;
    }
}
