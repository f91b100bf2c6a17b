// Morph: the functions of a mesh, and all that is done with them.
import { choice, number, refuse, show, whole } from "./errors.js";
import { describe, listed, of_basis, with_moved_centres } from "./conditions.js";
import { disposable, Owner } from "./library.js";

const OPERATORS = { conformal: "HM_CONFORMAL", laplace: "HM_LAPLACE", weighted: "HM_WEIGHTED" };
const ENGINES = { direct: "HM_DIRECT", multigrid: "HM_MULTIGRID", fas: "HM_FAS" };
const SCHEMES = { compact: "HM_COMPACT", bounded: "HM_BOUNDED", nodalGradient: "HM_NODAL_GRADIENT" };
const STRATEGIES = ["linear", "other", "substeps", "untangled", "improved"];

/** The functions that carry movements of control points to a mesh; see index.d.ts. */
export class Morph extends Owner {
    constructor(mesh, curves = null, conditions = {}, options = {}) {
        super();
        if (typeof mesh?.describe !== "function") refuse(`mesh must be a Mesh, not ${show(mesh)}.`);
        if (curves !== null && typeof curves?.describe !== "function") {
            refuse(`curves must be Curves or null, not ${show(curves)}.`);
        }
        this.begin(mesh.open(), curves, listed(mesh, curves, conditions), options);
        try {
            this.factor_and_solve();
        } catch (error) {
            this.free();
            throw error;
        }
    }

    // Takes what the functions are solved from. The mesh is copied, so that it may move or be freed.
    begin(mesh, curves, pairs, options) {
        this.curves = curves;
        this.pairs = pairs;
        this.options = options;
        this.solver_options = solver_options(this.library.constants, options);
        this.progress = options.progress;
        this.solveReport = null;
        this.basis = this.solver = this.problem = null;
        this.known = null; // places on curves that are not found by projection
        this.before = null; // the movement from the first analysis to the start; null: none
        if (mesh !== null) this.copy_mesh(mesh);
    }

    copy_mesh(mesh) {
        const scope = this.own(), bytes = 16 * mesh.nPoints;
        try {
            const start = scope.take(bytes);
            this.library.memory.u8.copyWithin(start, mesh.point_address, mesh.point_address + bytes);
            this.problem = { scope, mesh, start, address: mesh.describe(scope, start), projected: null };
        } catch (error) {
            this.disown(scope);
            throw error;
        }
    }

    // ---- Analysis, plan, basis ----

    // The basis is made at the coordinates of the first analysis, from which movements are recovered; where no
    // movement leads the wall from there to the start, at the start.
    factor_and_solve() {
        this.solve_from((body) => this.at_first(body));
        this.before = null;
        if (this.problem.projected === null || this.functions === 0) return;
        try {
            const move = this.recovered(this.start);
            if (move.some((one) => one !== 0)) this.before = move;
        } catch (error) {
            if (error.code !== "HM_BAD_MESH") throw error;
            this.solve_from((body) => body());
        }
    }

    solve_from(at) {
        const solver = this.ready(), { layout } = this.library;
        const scope = this.own();
        try {
            const address = at(() => scope.object("hm_basis_init", solver.analysis));
            const report = scope.struct("hm_solve_report");
            if (this.info_of(scope, address).functions > 0) {
                this.run((_progress) => this.library.call("hm_plan_solve", solver.plan, address, report));
            }
            this.solveReport = layout.read("hm_solve_report", report);
            this.take_basis(scope, address);
        } catch (error) {
            this.disown(scope);
            throw error;
        }
    }

    // Runs the body while the mesh has the coordinates of the first analysis.
    at_first(body) {
        const { mesh, start, projected } = this.problem;
        if (projected === null) return body();
        const now = this.start, numbers = () => this.library.memory.numbers(start, 2 * mesh.nPoints);
        numbers().set(projected);
        try {
            return body();
        } finally {
            numbers().set(now);
        }
    }

    info_of(scope, basis) {
        const info = scope.struct("hm_basis_info");
        this.library.call("hm_basis_info_get", basis, info);
        const found = this.library.layout.read("hm_basis_info", info);
        scope.drop(info);
        return found;
    }

    take_basis(scope, address) {
        if (this.basis !== null) this.disown(this.basis.scope);
        this.basis = { scope, address };
        this.info = this.info_of(scope, address);
        this.functions = this.info.functions;
        this.nPoints = this.info.points;
    }

    // Runs the body with the callback of this object.
    run(body) {
        return this.library.with_progress(this.progress, body);
    }

    /** The solver, made anew where it was released or the object was loaded; with a factor. */
    ready() {
        this.solver ??= this.make_solver();
        if (!this.solver.has_factor) {
            this.run((_progress) => this.library.call("hm_plan_factor", this.solver.plan, 0));
            this.solver.has_factor = true;
        }
        return this.solver;
    }

    make_solver() {
        if (this.problem === null) refuse("This call needs the mesh; give it to Morph.load().", "HM_BAD_BASIS");
        return this.at_first(() => this.solver_here()); // curve points keep the parameters of the first solution
    }

    solver_here() {
        const { mesh, address } = this.problem, scope = this.own();
        try {
            const known = this.known ?? { points: [], curves: [], u: [] };
            const curves = this.curves === null ? 0 : this.curves.describe(scope);
            const problem = scope.struct("hm_problem", {
                mesh: address,
                curves,
                n_conditions: this.pairs.length,
                conditions: describe(scope, mesh, this.curves, this.pairs),
                n_known: known.points.length,
                known_points: scope.integers(known.points, undefined, "known"),
                known_curves: scope.integers(known.curves, undefined, "known"),
                known_u: scope.numbers(known.u, undefined, "known"),
                max_curve_distance: number(this.options.maxCurveDistance ?? 0, "maxCurveDistance"),
            });
            return this.run((progress) => {
                const { study, ...members } = this.solver_options;
                const options = scope.struct("hm_options", { ...members, progress,
                    study: scope.struct("hm_study_options", study) });
                const analysis = scope.object("hm_analysis_init", problem, options);
                const plan = scope.object("hm_plan_init", analysis);
                return { scope, analysis, plan, has_factor: false };
            });
        } catch (error) {
            this.disown(scope);
            throw error;
        }
    }

    open() {
        if (this.basis === null) refuse("This object was freed.", "HM_BAD_BASIS");
        return this.basis.address;
    }

    /** The coordinates on which the functions were solved: a copy. */
    get start() {
        if (this.problem === null) return null;
        return this.library.memory.numbers(this.problem.start, 2 * this.nPoints).slice();
    }

    // hm_points of given coordinates; of the start where there are none.
    coordinates(scope, given, what = "points") {
        if (given !== undefined && given !== null) return scope.points(given, this.nPoints, what);
        if (this.problem === null) refuse(`A basis without a mesh has no coordinates; give ${what}.`);
        const { start } = this.problem;
        return scope.struct("hm_points", { x: start, y: start + 8, stride: 2 });
    }

    // ---- Movements by the functions ----

    /** Returns the displacement of each mesh point, sum_i F_i (dx, dy)_i. */
    displacement(move, { out } = {}) {
        const basis = this.open();
        return this.library.with((scope) => {
            const step = scope.numbers(move, 2 * this.functions, "move");
            const to = scope.points_out(out, this.nPoints);
            this.library.call("hm_morph", basis, step, 0, to.points, 0);
            return to.done();
        });
    }

    /** Returns moved coordinates, points + sum_i F_i (dx, dy)_i. */
    morph(move, { points, out } = {}) {
        const basis = this.open();
        return this.library.with((scope) => {
            const step = scope.numbers(move, 2 * this.functions, "move");
            const from = this.coordinates(scope, points), to = scope.points_out(out, this.nPoints);
            this.library.call("hm_morph", basis, step, from, to.points, 0);
            return to.done();
        });
    }

    /** Returns derivatives by the movement from those by the mesh points: the exact transpose. */
    adjoint(dj, { out } = {}) {
        const basis = this.open();
        return this.library.with((scope) => {
            const view = scope.points(dj ?? [], this.nPoints, "dj");
            const to = scope.numbers_out(out, 2 * this.functions);
            this.library.call("hm_adjoint", basis, view, to.address, 0);
            return to.done();
        });
    }

    /** Returns the functions as a dense array: planes, in each the points, for each point the functions. */
    matrix({ out } = {}) {
        const basis = this.open();
        return this.library.with((scope) => {
            const to = scope.numbers_out(out, this.info.numbersPerValue * this.nPoints * this.functions);
            this.library.call("hm_basis_matrix", basis, to.address);
            return to.done();
        });
    }

    /** Judges a movement before anything moves, or a mesh as it is: { step, quality, cells }. */
    assess(displacement = null, { points, reference, cells } = {}) {
        const basis = this.open();
        if (this.problem === null) refuse("This call needs the mesh; give it to Morph.load().", "HM_BAD_BASIS");
        return this.library.with((scope) => {
            const { layout } = this.library, n = this.nPoints;
            const step = displacement === null ? 0 : scope.struct("hm_step_report");
            const wanted = cells !== undefined && cells !== false;
            const each = wanted ? scope.numbers_out(cells === true ? null : cells, this.info.cells) : null;
            const quality = scope.struct("hm_quality_report", { cell_quality: each?.address ?? 0 });
            const from = scope.points(points, n, "points"), by = scope.points(displacement, n, "displacement");
            this.library.call("hm_assess", basis, this.problem.address, from, by,
                scope.points(reference, n, "reference"), 0, step, quality);
            return {
                step: step === 0 ? null : layout.read("hm_step_report", step),
                quality: layout.read("hm_quality_report", quality),
                cells: each?.done() ?? null,
            };
        });
    }

    /** Returns the largest distance of wall points from where their conditions take them. */
    boundaryError(move, moved, { points } = {}) {
        const basis = this.open();
        return this.library.with((scope) => {
            const error = scope.take(8);
            this.library.call("hm_boundary_error", basis, scope.numbers(move, 2 * this.functions, "move"),
                this.coordinates(scope, points), scope.points(moved ?? [], this.nPoints, "moved"), error, 0);
            return this.library.memory.numbers(error, 1)[0];
        });
    }

    /** Returns the movement that a mesh has made since the functions were solved. */
    recover(points, { tolerance = 0 } = {}) {
        const move = this.recovered(points, tolerance);
        return this.before === null ? move : move.map((one, k) => one - this.before[k]);
    }

    // The movement since the basis was made.
    recovered(points, tolerance = 0) {
        const basis = this.open();
        return this.library.with((scope) => {
            const view = scope.points(points ?? [], this.nPoints, "points");
            const to = scope.numbers_out(null, 2 * this.functions);
            number(tolerance, "tolerance");
            scope.with_memory((memory) =>
                this.library.call("hm_recover_movement", basis, view, tolerance, to.address, 0, memory));
            return to.done();
        });
    }

    // ---- Movements that solve on the way ----

    /** Moves the mesh from the start by a movement of any size, so that no cell inverts. */
    safe(move, options = {}) {
        const basis = this.open(), solver = this.ready();
        return this.library.with((scope) => {
            const step = scope.numbers(move, 2 * this.functions, "move");
            const target = scope.struct("hm_safe_target", { move: step });
            return this.moved_safely(scope, solver, basis, target, options);
        });
    }

    /** Does the same for displacements that are given at wall points; move: curves and bodies. */
    displaceSafe(wall, { move, wallPoints, ...options } = {}) {
        const basis = this.open(), solver = this.ready();
        return this.library.with((scope) => {
            const { n, list } = this.wall_points(scope, wallPoints);
            const field = scope.points(wall ?? [], n, "wall");
            const step = move === undefined ? 0 : scope.numbers(move, 2 * this.functions, "move");
            const target = scope.struct("hm_safe_target", { move: step, n, points: list, wall: field });
            return this.moved_safely(scope, solver, basis, target, options);
        });
    }

    // Moves to the target; returns { points, report, reached }.
    moved_safely(scope, solver, basis, target, options) {
        const { library } = this, to = scope.points_out(options.out, this.nPoints);
        const reached = scope.numbers_out(null, 2 * this.functions);
        const given = this.safe_options(scope, options, reached.address), report = scope.struct("hm_safe_report");
        try {
            this.run((_progress) => scope.with_memory((memory) =>
                library.call("hm_move_safe", solver.plan, basis, target, to.points, memory, given, report)));
        } catch (error) {
            const is_of_place = this.info.bodies > 0 || this.info.offsetCorrection !== 0;
            if (error.code !== "HM_BAD_BASIS" || this.known === null || !is_of_place) throw error;
            refuse("The mesh has moved since the first analysis of this basis, on which its rigid bodies or offsets " +
                "depend; call solve() first, or restore the coordinates.", "HM_BAD_BASIS");
        } finally {
            if (library.layout.get("hm_safe_report", report, "resolves") !== 0) this.solver.has_factor = false;
        }
        return { points: to.done(), report: library.layout.read("hm_safe_report", report), reached: reached.done() };
    }

    safe_options(scope, options, reached) {
        const { maxResolves = 0, skip = [], others = [], improve = false, heights = 0, minQuality = 0,
            maxHeightChange = 0 } = options;
        if (!Array.isArray(skip) || !Array.isArray(others)) refuse("skip and others must be arrays.");
        let skipped = 0;
        for (const name of skip) {
            if (!STRATEGIES.includes(name)) {
                refuse(`A strategy must be one of ${STRATEGIES.join(", ")}, not ${show(name)}.`);
            }
            skipped |= 1 << STRATEGIES.indexOf(name);
        }
        const bases = others.map((other) => (other instanceof Morph ? other.open() : refuse("others must be Morphs.")));
        return scope.struct("hm_safe_options", {
            max_resolves: whole(maxResolves, "maxResolves"),
            skipped_strategies: skipped,
            n_others: bases.length,
            improve: improve ? 1 : 0,
            others: scope.integers(bases, undefined, "others"),
            heights: number(heights, "heights"),
            reached,
            min_quality: number(minQuality, "minQuality"),
            max_height_change: number(maxHeightChange, "maxHeightChange"),
        });
    }

    /** Makes the cells of a moved mesh more like those before: { points, report }. */
    improve(points, { out, reference, maxSolutions = 0 } = {}) {
        this.open();
        const solver = this.ready();
        return this.library.with((scope) => {
            const from = scope.points(points ?? [], this.nPoints, "points"), to = scope.points_out(out, this.nPoints);
            const options = scope.struct("hm_improve_options", {
                max_solutions: whole(maxSolutions, "maxSolutions"),
                reference: scope.points(reference, this.nPoints, "reference"),
            });
            const report = scope.struct("hm_improve_report");
            this.run((_progress) => scope.with_memory((memory) =>
                this.library.call("hm_improve", solver.plan, from, to.points, memory, options, report)));
            return { points: to.done(), report: this.library.layout.read("hm_improve_report", report) };
        });
    }

    /** Puts points with slip back onto their curved boundary after a morph. */
    slip(points, { out } = {}) {
        this.open();
        const solver = this.ready();
        return this.library.with((scope) => {
            const from = scope.points(points ?? [], this.nPoints, "points"), to = scope.points_out(out, this.nPoints);
            this.library.call("hm_slip", solver.analysis, from, to.points);
            return to.done();
        });
    }

    // ---- Displacements that are given at wall points ----

    /** The wall points with given displacements, in order. */
    get givenPoints() {
        this.open();
        const solver = this.ready();
        return this.library.with((scope) => {
            const { memory } = this.library, points = scope.take(4 * this.nPoints), n = scope.take(4);
            this.library.call("hm_given_points", solver.plan, points, this.nPoints, n);
            return memory.integers(points, memory.data.getInt32(n, true)).slice();
        });
    }

    // The list of wall points and its address, 0 for the order of givenPoints.
    wall_points(scope, given) {
        if (given === undefined) return { n: this.givenPoints.length, list: 0 };
        return { n: given?.length, list: scope.integers(given, undefined, "wallPoints") };
    }

    /** Carries displacements of wall points to the mesh; an array of fields gives an array. */
    displace(wall, { points, out, wallPoints } = {}) {
        this.open();
        const solver = this.ready(), is_stack = Array.isArray(wall) && typeof wall[0] === "object";
        const fields = is_stack ? wall : [wall];
        if (is_stack && out !== undefined) refuse("out is for a single field.");
        return this.library.with((scope) => {
            const { n, list } = this.wall_points(scope, wallPoints);
            const from = points === undefined ? 0 : this.coordinates(scope, points);
            const views = fields.map((field) => scope.numbers(field ?? [], 2 * n, "wall"));
            const targets = fields.map(() => scope.numbers_out(out, 2 * this.nPoints));
            const given = stack(scope, "hm_points", views);
            const wanted = stack(scope, "hm_points_out", targets.map((to) => to.address));
            scope.with_memory((memory) => this.library.call("hm_displace", solver.plan, n, list, fields.length, given,
                from, wanted, memory, 0));
            const results = targets.map((to) => to.done());
            return is_stack ? results : results[0];
        });
    }

    /** The transpose of displace(): forces on mesh points become forces on the wall. */
    displaceAdjoint(dj, { wallPoints } = {}) {
        this.open();
        const solver = this.ready(), is_stack = Array.isArray(dj) && typeof dj[0] === "object";
        const fields = is_stack ? dj : [dj];
        return this.library.with((scope) => {
            const { n, list } = this.wall_points(scope, wallPoints);
            const views = fields.map((field) => scope.numbers(field ?? [], 2 * this.nPoints, "dj"));
            const targets = fields.map(() => scope.numbers_out(null, 2 * n));
            const given = stack(scope, "hm_points", views);
            const wanted = stack(scope, "hm_points_out", targets.map((to) => to.address));
            scope.with_memory((memory) => this.library.call("hm_displace_adjoint", solver.plan, n, list,
                fields.length, given, wanted, memory, 0));
            const results = targets.map((to) => to.done());
            return is_stack ? results : results[0];
        });
    }

    // ---- Again, files, the end ----

    /** Solves again, on other coordinates of the mesh points, which become the start. */
    solve(points) {
        this.open();
        const solver = this.ready();
        const { mesh, start, projected } = this.problem, before = this.start;
        if (points !== undefined) {
            this.library.with((scope) => {
                const from = scope.numbers(points, 2 * mesh.nPoints, "points");
                this.library.memory.u8.copyWithin(start, from, from + 16 * mesh.nPoints);
            });
            solver.has_factor = false;
        }
        try {
            this.problem.projected ??= before;
            this.factor_and_solve();
        } catch (error) {
            this.problem.projected = projected;
            this.library.memory.numbers(start, before.length).set(before);
            solver.has_factor = false;
            throw error;
        }
    }

    /** Returns the bytes of a basis file, which C, Fortran, Python and the program read. */
    save() {
        const address = this.open();
        return this.library.memory.u8.slice(address, address + this.info.bytes);
    }

    /** Attaches a basis file; see index.d.ts. */
    static load(bytes, mesh = null) {
        if (!(bytes instanceof Uint8Array)) refuse(`bytes must be a Uint8Array, not ${show(bytes)}.`);
        if (mesh !== null && typeof mesh.describe !== "function") refuse(`mesh must be a Mesh, not ${show(mesh)}.`);
        const morph = Object.create(this.prototype);
        morph.begin(mesh?.open() ?? null, null, [], {});
        const scope = morph.own(), { library } = this;
        try {
            const block = scope.take(bytes.length);
            library.memory.u8.set(bytes, block);
            const slot = scope.take(4);
            const status = library.call("hm_basis_attach", slot, block, bytes.length, mesh === null ? 0 : mesh.address);
            morph.take_basis(scope, library.memory.data.getUint32(slot, true));
            morph.restore();
            if (mesh !== null && morph.functions > 0) morph.find_curves(status === library.constants.HM_MOVED);
        } catch (error) {
            morph.disown(scope);
            morph.free();
            throw error;
        }
        return morph;
    }

    // Curves, conditions and options with which the basis was solved, for calls that need analysis and plan.
    restore() {
        const { info, library, problem } = this, { Curves } = library.bound;
        this.solver_options = {
            operator_kind: info.operatorKind,
            engine: info.engine,
            exponent: info.exponent || -1,
            offset_correction: info.offsetCorrection,
            study: { scheme: info.scheme },
        };
        if (info.curves > 0) this.curves = Curves.of_basis("hm_basis_curves", info.curves, this.basis.address, 0, 0);
        if (problem !== null) this.pairs = of_basis(library, problem.mesh, this.basis.address, Curves);
    }

    // Finds the curves and the centres of bodies at the coordinates of the mesh. Points keep their places on curves.
    find_curves(has_moved) {
        this.known = this.places();
        let move;
        try {
            move = this.recovered(this.start);
        } catch (error) {
            // The wall is on no curve of the basis, or the basis does not have all of its functions.
            if (error.code !== "HM_BAD_MESH" && error.code !== "HM_BAD_BASIS") throw error;
            return;
        }
        if (move.every((one) => one === 0)) return;
        const { Curves } = this.library.bound, { curves, controlPoints, modes, bodies } = this.info;
        if (curves > 0) {
            this.curves = this.library.with((scope) => Curves.of_basis("hm_basis_curves", curves, this.basis.address,
                scope.copied(move), scope.take(16 * controlPoints)));
        }
        this.pairs = with_moved_centres(this.pairs, move.subarray(2 * (this.functions - modes - 2 * bodies)));
        if (!has_moved) this.before = move;
    }

    // The mesh points on curves, their curves and their parameters.
    places() {
        return this.library.with((scope) => {
            const { layout, memory } = this.library, info = scope.struct("hm_basis_info");
            this.library.call("hm_basis_info_get", this.basis.address, info);
            const of = (member) => layout.get("hm_basis_info", info, member), n = of("curve_points");
            const points = [...memory.integers(of("curve_point"), n)];
            const numbers = [...memory.integers(of("point_curve"), n)], u = [...memory.numbers(of("point_u"), n)];
            const on_curve = (_, k) => numbers[k] < of("curves"); // the others belong to bodies, or are given
            return { points: points.filter(on_curve), curves: numbers.filter(on_curve), u: u.filter(on_curve) };
        });
    }

    /** Gives analysis and plan back. Calls that need them make them again, which takes time. */
    release() {
        if (this.solver !== null) this.solver = this.disown(this.solver.scope);
    }

    /** Gives all memory back; later calls are refused. */
    free() {
        this.release();
        if (this.basis !== null) this.basis = this.disown(this.basis.scope);
        if (this.problem !== null) this.problem = this.disown(this.problem.scope);
    }
}
disposable(Morph);

function solver_options(constants, options) {
    const { operator = "conformal", engine = "direct", scheme = "compact", exponent, offsetCorrection = false,
        tolerance = 0 } = options;
    return {
        operator_kind: constants[choice(OPERATORS, operator, "operator")],
        engine: constants[choice(ENGINES, engine, "engine")],
        exponent: exponent === undefined ? 0 : number(exponent, "exponent") || -1,
        offset_correction: offsetCorrection ? 1 : 0,
        tolerance: number(tolerance, "tolerance"),
        study: { scheme: constants[choice(SCHEMES, scheme, "scheme")] },
    };
}

function stack(scope, struct, addresses) {
    // hm_points and hm_points_out have no struct_size.
    return scope.structs(struct, addresses.map((x) => ({ x, y: x + 8, stride: 2 })));
}
