// usage: node package.mjs PACKAGE KERNEL   Every call of the package, by properties. Ends with "N passed, M failed".
import { boundary, CONTROL, NI, NJ, POINTS, points, triangles } from "./case.mjs";
import { sequence } from "./sequences.mjs";

const { load } = await import(process.argv[2]);
const warnings = [];
const hm = await load({ kernel: process.argv[3], onWarning: (finding) => warnings.push(finding) });
const XY = points();
let passed = 0, failed = 0;

export function check(what, is_so, detail = "") {
    if (is_so) ++passed;
    else {
        ++failed;
        console.log(`FAIL web: ${what} ${detail}`);
    }
}
function near(what, a, b, tolerance = 1e-12) {
    let worst = a.length === b.length ? 0 : Infinity;
    for (let k = 0; k < a.length; ++k) {
        const off = Math.abs(a[k] - b[k]);
        if (!(off <= worst)) worst = off;
    }
    check(what, worst <= tolerance, `differ by ${worst}`);
}
function refused(what, code, body) {
    try {
        body();
        check(what, false, "was not refused");
    } catch (error) {
        const is_right = error instanceof hm.HarmorphError && error.code === code && error.message.length > 10;
        check(what, is_right, `${error.code}: ${error.stack}`);
        return error;
    }
    return {};
}
const dot = (a, b) => a.reduce((sum, one, k) => sum + one * b[k], 0);
let seed = 1;
function random() {
    seed = Math.imul(seed ^ (seed >>> 15), 0x2c1b3c6d) + 0x9e3779b9 | 0;
    return ((Math.imul(seed ^ (seed >>> 13), 0x297a2d39) >>> 0) + 0.5) / 2 ** 32;
}
const vector = (n, size = 1) => Float64Array.from({ length: n }, () => size * (2 * random() - 1));
const CURVE = new Map([[1, "curve"]]);

check("version", /^\d+\.\d+\.\d+$/.test(hm.version));
check("kernel", hm.kernel === process.argv[3]);

// ---- Mesh ----

const structured = new hm.Mesh(XY, { ni: NI, nj: NJ }, boundary());
const quads = [];
for (let j = 0; j < NJ - 1; ++j) {
    for (let i = 0; i < NI - 1; ++i) quads.push(i + NI * j, i + 1 + NI * j, i + 1 + NI * (j + 1), i + NI * (j + 1));
}
const n_cells = quads.length / 4;
const half = Math.floor(n_cells / 2);
const start = Array.from({ length: n_cells + 1 }, (_, k) => 4 * k);
const edges = (run) => ({ edges: Array.from({ length: 2 * (NI - 1) }, (_, k) => run[(k >> 1) + (k & 1)]) });
const named = { wall: boundary().get(1), far: edges(boundary().get(2)) };
const layouts = {
    quads: { quads },
    rows: { start, points: quads },
    mixed: {
        triangles: triangles().slice(0, 6 * half),
        quads: quads.slice(4 * half),
    },
    polygons: { start, points: quads, polygons: true },
    blocks: { blocks: [[NI, NJ]] },
};
const report = structured.report();
check("report of a structured mesh", report.points === POINTS && report.quads === n_cells && report.inverted === 0);
check("cells are counted", structured.nCells === n_cells && structured.nPoints === POINTS);
for (const [name, cells] of Object.entries(layouts)) {
    const mesh = new hm.Mesh(Array.from(XY), cells, named);
    const found = mesh.report();
    const expected = name === "mixed" ? n_cells + half : n_cells;
    check(`${name}: cells`, found.cells === expected && mesh.nCells === expected && found.boundaryLoops === 2,
        JSON.stringify(found));
    check(`${name}: markers by name`, mesh.markers.get("far") === 0 && mesh.markers.get("wall") === 1);
    check(`${name}: coordinates`, mesh.points.every((x, k) => x === XY[k]));
    mesh.free();
}
const wall = structured.wall(1);
check("points of the wall are a loop", wall.isLoop && wall.points.length === NI - 1);
structured.points[0] += 0;
check("coordinates are a view", hm.memory.buffer === structured.points.buffer);

// ---- Curves ----

const curves = hm.Curves.fit(structured, 1, { nControl: CONTROL, closed: "periodic" });
check("a fit", curves.nControl === CONTROL && curves.fitReport.maxError < 0.02 && curves.markers[0] === 1);
const [first, last] = curves.range();
near("a periodic curve is closed", curves.points([first]), curves.points([last]));
const u = first + 0.3 * (last - first), [x, y] = curves.points([u]);
const projected = curves.project([x, y]);
check("a point of the curve projects onto itself", Math.abs(projected.u - u) < 1e-9 && projected.distance < 1e-12);
const h = 1e-6, tangent = curves.points([u], { derivative: 1 });
near("derivatives of a curve", tangent,
    curves.points([u + h]).map((one, k) => (one - curves.points([u - h])[k]) / 2 / h), 1e-6);
const chord = [[-1.5, 0], [1.5, 0]];
const measured = curves.measure(["area", { kind: "thickness", station: 0.4 }], { chord });
check("the area of an ellipse", Math.abs(measured.values[0] - Math.PI * 1.5 * 0.5) < 0.02);
const change = vector(2 * CONTROL), by = (s) => curves.moved(change.map((one) => s * one));
for (const k of [0, 1]) {
    const kind = ["area", { kind: "thickness", station: 0.4 }][k];
    const slope = (by(h).measure(kind, { chord }).values[0] - by(-h).measure(kind, { chord }).values[0]) / 2 / h;
    const row = measured.gradients.slice(2 * CONTROL * k, 2 * CONTROL * (k + 1));
    check("derivatives of a measure", Math.abs(dot(row, change) - slope) < 1e-6, `${dot(row, change)} ${slope}`);
}
near("smoothing over a length of 0 changes nothing", curves.smooth(change, 0), change);
check("smoothing keeps a direction of ascent", dot(curves.smooth(change, 0.5), change) > 0);
const tied = hm.Curves.fitPoints(Array.from({ length: 122 }, (_, k) => {
    const t = 2 * Math.PI * (k >> 1) / 61, s = (1 + Math.cos(t)) / 2;
    return k % 2 === 0 ? s : 0.3 * Math.sin(t) * (1 - s) ** 1;
}), true, { nControl: 12, closed: "tied" });
check("points in order, tied at the sharp edge", tied.curves[0].indices[0] === tied.curves[0].indices.at(-1));
const [tied_first, tied_last] = tied.range();
const thicker = Array.from({ length: 100 }, (_, k) => tied.points([tied_first + k / 100 * (tied_last - tied_first)]))
    .flatMap(([px, py]) => [px, 1.2 * py]);
const refitted = tied.refit(thicker, true, { onChord: false });
check("another airfoil", refitted.report.maxError < 0.01 && refitted.move.some((one) => Math.abs(one) > 0.005),
    JSON.stringify(refitted.report));
near("curves from their own arrays", new hm.Curves(tied.control, tied.curves).points([0.37]), tied.points([0.37]), 0);

// ---- Morph ----

const before = hm.bytesInUse;
const morph = new hm.Morph(structured, curves, {}, { operator: "conformal" });
check("functions", morph.functions === CONTROL && morph.nPoints === POINTS && morph.solveReport.residual < 1e-9);
const a = vector(2 * CONTROL, 0.05), b = vector(2 * CONTROL, 0.05), d = morph.displacement(a);
near("displacements are linear", morph.displacement(a.map((one, k) => one + 2 * b[k])),
    d.map((one, k) => one + 2 * morph.displacement(b)[k]));
near("morph = start + displacement", morph.morph(a), d.map((one, k) => XY[k] + one), 1e-14);
near("points of the caller", morph.morph(a, { points: morph.morph(b) }),
    morph.morph(a.map((one, k) => one + b[k])), 1e-12);
const in_place = XY.slice();
check("out is returned", morph.morph(a, { points: in_place, out: in_place }) === in_place);
near("in place", in_place, morph.morph(a), 0);
const numbers = new hm.Numbers(2 * POINTS), step_of = new hm.Numbers(2 * CONTROL);
step_of.view.set(a);
check("numbers of the memory are returned", morph.displacement(step_of, { out: numbers }) === numbers);
near("without a copy", numbers.view, d, 0);
const w = vector(2 * POINTS);
const gradient = morph.adjoint(w);
check("the adjoint is the transpose", Math.abs(dot(d, w) - dot(a, gradient)) < 1e-12 * POINTS);
numbers.view.set(w);
near("adjoint of numbers of the memory", morph.adjoint(numbers), gradient, 0);
const judged = morph.assess(d);
check("assessment", judged.quality.inverted === 0 && judged.step.admissible > 1 && judged.quality.minQuality > 0);
const { cells: each } = morph.assess(d, { cells: true }), least = judged.quality.minQuality;
check("the quality of each cell", judged.cells === null && each.length === morph.info.cells &&
    Math.min(...each) === least && each.indexOf(least) === judged.quality.minQualityCell);
const of_cells = new hm.Numbers(morph.info.cells);
check("in numbers of the memory", morph.assess(d, { cells: of_cells }).cells === of_cells);
near("the same numbers", of_cells.view, each, 0);
of_cells.free();
refused("an array of another length", "HM_BAD_ARGUMENT", () => morph.assess(d, { cells: new Float64Array(3) }));
const too_far = morph.displacement(a.map((one) => 1.001 * judged.step.admissible * one));
check("the admissible step is that of the first inverted cell",
    morph.assess(too_far).quality.inverted > 0 || judged.step.boundary <= judged.step.admissible);
const matrix = morph.matrix(), planes = matrix.length / POINTS / CONTROL;
check("complex functions have two planes", planes === 2 && morph.info.numbersPerValue === 2);
const row = (plane, k, axis) => dot(matrix.subarray((plane * POINTS + k) * CONTROL, (plane * POINTS + k + 1) * CONTROL),
    a.filter((_, i) => i % 2 === axis));
near("the dense array gives the displacements",
    d.map((_, i) => (i % 2 === 0 ? row(0, i >> 1, 0) - row(1, i >> 1, 1) : row(1, i >> 1, 0) + row(0, i >> 1, 1))), d);
const as_is = morph.assess();
check("a mesh as it is", as_is.step === null && as_is.quality.inverted === 0);
check("wall points are where the curve takes them", morph.boundaryError(a, morph.morph(a)) < 1e-12);
near("the movement from the mesh", morph.recover(morph.morph(a)), a, 1e-9);
near("the start", morph.start, XY, 0);

// A turn of the body by 80 degrees.
const large = curves.control.map((_, k) => {
    const [cx, cy] = curves.control.slice(k & ~1, (k & ~1) + 2), cosine = Math.cos(1.4), sine = Math.sin(1.4);
    return k % 2 === 0 ? cosine * cx - sine * cy - cx : sine * cx + cosine * cy - cy;
});
const safe = morph.safe(large);
check("a large movement stays valid", morph.assess(null, { points: safe.points }).quality.inverted === 0);
check("its report", safe.report.stepFraction === 1 && safe.report.inverted === 0 && safe.report.worst.length === 5);
near("the whole movement is reached", safe.reached, large, 1e-12);
check("linear morphs go on afterwards", morph.displacement(a).every((one, k) => one === d[k]));
const harmonic = new hm.Morph(structured, curves, CURVE, { operator: "laplace" });
const limited = harmonic.safe(large, { maxResolves: -1, skip: ["untangled", "improved", "other"] });
harmonic.free();
check("what is possible without another solution", limited.report.stepFraction < 1 && limited.report.resolves === 0);
check("is a warning", warnings.at(-1)?.code === "HM_SHORT" && warnings.at(-1).message.length > 20);
const shaken = morph.morph(a);
const better = morph.improve(shaken, { maxSolutions: 5 });
check("improved cells", better.report.minQuality >= better.report.minQualityBefore);
morph.solve(morph.morph(a));
near("solved again: the start is the new mesh", morph.start, in_place, 0);
check("solved again: functions carry movements of the wall",
    morph.boundaryError(b, morph.morph(b)) < 1e-10);
const not_released = morph.safe(b).points;
morph.release();
const again = morph.safe(b);
check("released: made again where it is needed", again.report.stepFraction === 1);
near("released: the same mesh", again.points, not_released, 0);
morph.solve(XY);
near("solved on the old start: the old functions", morph.displacement(a), d, 1e-12);

// ---- Files ----

const file = morph.save(), loaded = hm.Morph.load(file, structured);
near("a basis that was saved and loaded", loaded.displacement(a), morph.displacement(a), 0);
check("loaded: assessment", loaded.assess(d).quality.inverted === 0);
const alone = hm.Morph.load(file);
near("loaded without a mesh", alone.morph(a, { points: XY }), morph.morph(a), 0);
refused("loaded without a mesh: no coordinates", "HM_BAD_ARGUMENT", () => alone.morph(a));
refused("loaded without a mesh: no plan", "HM_BAD_BASIS", () => alone.safe(a));
near("loaded: analysis and plan are made again", loaded.safe(a).points, morph.safe(a).points, 0);
loaded.free();
alone.free();
const solid = new hm.Morph(structured, null, new Map([[1, { kind: "rigid" }]])), shift = [0.01, 0, 0, 0];
const shifted = new hm.Mesh(solid.morph(shift), { ni: NI, nj: NJ }, boundary());
const on_shifted = hm.Morph.load(solid.save(), shifted);
const { message } = refused("loaded on a mesh that has moved", "HM_BAD_BASIS", () => on_shifted.safe(shift));
check("the refusal says what to do", message.includes("first analysis of this basis") && message.includes("solve()"),
    message);
on_shifted.solve();
check("and safe() works after solve()", on_shifted.safe(shift).report.stepFraction === 1);
for (const one of [on_shifted, shifted, solid]) one.free();

// ---- Quality ----

const quality = new hm.Quality(morph);
const bounds = quality.bounds(["area", { kind: "quality", sharpness: 50 }], { points: in_place });
check("bounds", bounds.length === 2 && bounds.every(({ value, extreme }) => value <= extreme));
const turn = vector(2 * POINTS, 1e-3);
const at = (s) => quality.bounds("area", { points: in_place.map((one, k) => one + s * turn[k]), gradients: false })[0];
const slope = (at(1e-3).value - at(-1e-3).value) / 2e-3;
check("derivatives of a bound", Math.abs(dot(bounds[0].gradient, turn) - slope) < 1e-5 * Math.abs(slope) + 1e-9,
    `${dot(bounds[0].gradient, turn)} ${slope}`);
const [corner] = quality.corners(d);
check("the corner that limits the step", corner.cell === judged.step.cell && corner.step === judged.step.admissible);
quality.free();

// ---- Given displacements, rigid bodies, slip ----

const given = new hm.Morph(structured, null, new Map([[1, "given"]]));
const wall_points = given.givenPoints, field = vector(2 * wall_points.length, 0.01);
const moved = given.displace(field);
check("wall points move by the given bits",
    wall_points.every((k, i) => moved[2 * k] === field[2 * i] && moved[2 * k + 1] === field[2 * i + 1]));
near("displaced coordinates", given.displace(field, { points: XY }), moved.map((one, k) => one + XY[k]), 1e-14);
const both = given.displace([field, field.map((one) => 2 * one)]);
near("two fields at once", both[1], both[0].map((one) => 2 * one), 1e-12);
const reversed = Int32Array.from(wall_points).reverse();
const turned = field.map((_, k) => field[field.length - 2 * ((k >> 1) + 1) + (k & 1)]);
near("wall points in another order", given.displace(turned, { wallPoints: reversed }), moved, 0);
const force = given.displaceAdjoint(w);
check("the transpose does the same work", Math.abs(dot(moved, w) - dot(field, force)) < 1e-11 * POINTS);
check("two fields of forces", given.displaceAdjoint([w, w])[1].every((one, k) => one === force[k]));
const gently = given.displaceSafe(field);
check("displaced safely", gently.report.stepFraction === 1 && gently.report.inverted === 0);
given.free();

const kept = hm.Curves.fit(structured, 2, { nControl: CONTROL, closed: "periodic" });
const along = new hm.Morph(structured, curves, new Map([[1, "curve"], [2, { kind: "slip", along: kept }]]));
const along_again = hm.Morph.load(along.save(), structured);
near("slip along curves, saved and loaded", along_again.slip(along.morph(a)), along.slip(along.morph(a)), 0);
along.free();
along_again.free();

const body = new hm.Morph(structured, null, new Map([[1, { kind: "rigid", body: 0, centre: [0, 0] }], [2, "slip"]]),
    { operator: "laplace" });
const angle = 0.1, rigid = [0.01, 0.02, Math.cos(angle) - 1, Math.sin(angle)];
const rotated = body.morph(rigid);
const expected = Array.from(wall.points).flatMap((k) => [
    XY[2 * k] * Math.cos(angle) - XY[2 * k + 1] * Math.sin(angle) + 0.01,
    XY[2 * k] * Math.sin(angle) + XY[2 * k + 1] * Math.cos(angle) + 0.02,
]);
near("a rigid body", Array.from(wall.points).flatMap((k) => [rotated[2 * k], rotated[2 * k + 1]]), expected, 1e-12);
const slipped = body.slip(rotated);
check("points with slip are back on the boundary", slipped.length === 2 * POINTS && slipped !== rotated);
body.free();

// ---- Progress and cancellation ----

const phases = new Set();
new hm.Morph(structured, curves, CURVE, { progress: (phase) => void phases.add(phase) }).free();
check("phases are named", phases.size > 2 && ![...phases].includes(""), [...phases].join());
refused("a call that is stopped", "HM_CANCELLED",
    () => new hm.Morph(structured, curves, CURVE, { progress: () => false }));
let thrown = null;
try {
    new hm.Morph(structured, curves, CURVE, { progress: () => { throw new RangeError("mine"); } });
} catch (error) {
    thrown = error;
}
check("what the callback throws reaches the caller", thrown instanceof RangeError && thrown.message === "mine");

// ---- Errors ----

const folded = XY.slice();
folded[2 * (NI * 3 + 7)] += 1;
const bad = refused("an inverted cell", "HM_BAD_MESH", () => {
    const mesh = new hm.Mesh(folded, { ni: NI, nj: NJ }, boundary());
    try {
        new hm.Morph(mesh, curves, CURVE);
    } finally {
        mesh.free();
    }
});
check("names the cell and the place", bad.kind === "cell" && bad.item >= 0 && Number.isFinite(bad.x) && bad.value <= 0,
    JSON.stringify(bad));
refused("an unknown marker", "HM_BAD_CONDITION", () => hm.Curves.fit(structured, "wing"));
refused("a short movement", "HM_BAD_ARGUMENT", () => morph.displacement([1, 2]));
refused("no numbers", "HM_BAD_ARGUMENT", () => morph.displacement("move"));
refused("an unknown operator", "HM_BAD_ARGUMENT",
    () => new hm.Morph(structured, curves, CURVE, { operator: "elastic" }));
refused("a free conformal boundary", "HM_UNSUPPORTED",
    () => new hm.Morph(structured, curves, new Map([[1, "curve"], [2, "free"]])));
refused("a boundary without markers", "HM_BAD_MESH", () => {
    const mesh = new hm.Mesh(XY, { triangles: triangles() }, { wall: boundary().get(1) });
    try {
        mesh.report();
    } finally {
        mesh.free();
    }
});
refused("knots that are no knots", "HM_BAD_CURVE", () => new hm.Curves([0, 0, 1, 0, 2, 1, 3, 3],
    [{ degree: 3, knots: [0, 0, 0, 0, 1, 1, 1, Infinity] }]));
const too_large = refused("numbers that 4 GiB cannot hold", "HM_BLOCK_TOO_SMALL", () => new hm.Numbers(2 ** 29));
check("and the bytes that are needed", too_large.value === 2 ** 32 && too_large.message.includes("4294967296"));
morph.free();
refused("a freed object", "HM_BAD_BASIS", () => morph.displacement(a));
numbers.free();
step_of.free();
check("free() gives everything back", hm.bytesInUse === before, `${hm.bytesInUse - before} bytes`);

// ---- 100 meshes one after the other ----

let pages = 0, in_use = 0;
for (let k = 0; k < 100; ++k) {
    const mesh = new hm.Mesh(XY.map((one) => one * (1 + 0.001 * k)), { triangles: triangles() }, boundary());
    const fitted = hm.Curves.fit(mesh, 1, { nControl: CONTROL });
    const one = new hm.Morph(mesh, fitted);
    one.assess(one.displacement(a));
    one.free();
    mesh.free();
    if (k === 2) [pages, in_use] = [hm.memory.buffer.byteLength, hm.bytesInUse];
}
check("100 meshes keep the memory flat", hm.memory.buffer.byteLength === pages && hm.bytesInUse === in_use,
    `${pages} ${hm.memory.buffer.byteLength} ${in_use} ${hm.bytesInUse}`);

// ---- Damaged input: an error object or a result, no hang, nothing lost ----

function survives(what, body) {
    let others = 0, refusals = 0;
    const held = hm.bytesInUse;
    for (let k = 0; k < 200; ++k) {
        try {
            body(k);
        } catch (error) {
            if (error instanceof hm.HarmorphError) ++refusals;
            else if (++others === 1) console.log(error);
        }
    }
    check(`${what}: errors are objects`, others === 0 && refusals > 50, `${others} others, ${refusals} refusals`);
    check(`${what}: nothing is lost`, hm.bytesInUse === held, `${hm.bytesInUse - held} bytes`);
}
const any = (...values) => values[Math.floor(random() * values.length)];
survives("damaged basis files", (k) => {
    const damaged = k % 4 === 0 ? file.slice(0, Math.floor(random() * file.length)) : file.slice();
    for (let n = 0; n < 1 + k % 5 && damaged.length > 0; ++n) {
        const place = Math.floor(random() * (k % 2 === 0 ? Math.min(400, damaged.length) : damaged.length));
        damaged[place] ^= 1 << Math.floor(8 * random());
    }
    const one = hm.Morph.load(damaged, any(structured, null));
    try {
        one.displacement(a);
    } finally {
        one.free();
    }
});
survives("damaged meshes", (k) => {
    const xy = XY.slice(), list = triangles();
    for (let n = 0; n < 3; ++n) {
        if (k % 2 === 0) xy[Math.floor(random() * xy.length)] = any(NaN, Infinity, -1e300, 1e101, 0, 1e-320);
        else list[Math.floor(random() * list.length)] = any(-1, POINTS, 2 ** 31 - 1, -(2 ** 31), 0, 17);
    }
    const runs = boundary();
    if (k % 5 === 0) runs.set(1, runs.get(1).map((one) => (random() < 0.05 ? any(-5, POINTS + 3, 12) : one)));
    const mesh = new hm.Mesh(xy, { triangles: list }, runs);
    try {
        new hm.Morph(mesh, curves, CURVE).free();
    } finally {
        mesh.free();
    }
});
survives("arguments of other types", () => {
    const anything = () => any(null, undefined, "x", {}, [], [1], -1, NaN, new Float64Array(3), 2 ** 40, new Map(),
        true, [NaN], { kind: "slip" }, { length: 4 }, new Int32Array(4), [[1, 2]], Symbol.iterator, 1n, () => 1);
    const mesh = any(() => new hm.Mesh(anything(), anything(), anything()),
        () => new hm.Mesh(XY, any({ ni: anything(), nj: NJ }, { triangles: anything() },
            { start: anything(), points: quads }, { blocks: anything() }), boundary()),
        () => new hm.Mesh(XY, { ni: NI, nj: NJ }, new Map([[1, anything()]])),
        () => hm.Curves.fit(structured, anything(), { nControl: anything() }),
        () => hm.Curves.fitPoints(anything(), true, { degree: anything() }),
        () => new hm.Curves(anything(), anything()),
        () => new hm.Morph(structured, curves, anything(), { tolerance: anything() }),
        () => new hm.Numbers(anything()))();
    mesh.free?.();
});
structured.free();
for (let k = 0; k < 20; ++k) sequence(hm, near, random);
check("at the end nothing is in use but the error", hm.bytesInUse < 1000, `${hm.bytesInUse} bytes`);
console.log(`${passed} passed, ${failed} failed`);
process.exitCode = failed === 0 ? 0 : 1;
