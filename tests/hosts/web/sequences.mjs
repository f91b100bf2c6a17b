// Random sequences of calls on a mesh that moves: after each call, the wall and the rigid outer boundary are where
// formulas lead them. The mesh lies between a B-spline and a circle.
const NI = 30, NJ = 8, N = 8, DEGREE = 3;

/** Returns a movement in pairs of numbers from the parts of the curve and of the body. */
const joined = ({ control, shift, turn }) => Float64Array.of(...control, ...shift, ...turn);
const times = ([a, b], [c, d]) => [a * c - b * d, a * d + b * c];
const sum = (a, b) => a.map((one, k) => one + b[k]);
const added = (a, b) => Object.fromEntries(Object.keys(a).map((part) => [part, sum(a[part], b[part])]));
const zero = () => ({ control: new Array(2 * N).fill(0), shift: [0, 0], turn: [0, 0] });
const ring = (j) => Int32Array.from({ length: NI }, (_, i) => i + NI * j);

function mesh_of(hm, curves, u) {
    const wall = curves.points(u), first = Math.atan2(wall[1], wall[0]), xy = new Float64Array(2 * NI * NJ);
    for (let k = 0; k < NI * NJ; ++k) {
        const i = k % NI, t = (Math.floor(k / NI) / (NJ - 1)) ** 1.5;
        const angle = first + 2 * Math.PI * (i % (NI - 1)) / (NI - 1);
        xy[2 * k] = (1 - t) * wall[2 * i] + 6 * t * Math.cos(angle);
        xy[2 * k + 1] = (1 - t) * wall[2 * i + 1] + 6 * t * Math.sin(angle);
    }
    return xy;
}

/** near(what, a, b, tolerance); random(): 0 to 1. */
export function sequence(hm, near, random) {
    const any = (size) => size * (2 * random() - 1), one_of = (list) => list[Math.floor(random() * list.length)];
    const indices = Array.from({ length: N + DEGREE }, (_, k) => k % N);
    const knots = Array.from({ length: N + 2 * DEGREE + 1 }, (_, k) => k);
    const control = indices.slice(0, N).flatMap((k) => {
        const angle = 2 * Math.PI * k / N, radius = 1 + any(0.05);
        return [radius * Math.cos(angle), 0.7 * radius * Math.sin(angle)];
    });
    const curves = new hm.Curves(control, [{ degree: DEGREE, indices, knots }]);
    const u = Array.from({ length: NI }, (_, i) => DEGREE + N * (i % (NI - 1)) / (NI - 1));
    const boundary = new Map([["wall", ring(0)], ["far", ring(NJ - 1)]]);
    const with_mesh = (xy, make) => { // a Morph copies its mesh
        const mesh = new hm.Mesh(xy, { ni: NI, nj: NJ }, boundary), morph = make(mesh);
        mesh.free();
        return morph;
    };
    let points = mesh_of(hm, curves, u), first = points, centre = [any(1), any(1)];
    let total = zero(), at_start = zero();
    const conditions = new Map([["wall", "curve"], ["far", { kind: "rigid", centre }]]);
    const operator = one_of(["conformal", "laplace", "weighted"]);
    let morph = with_mesh(points, (mesh) => new hm.Morph(mesh, curves, conditions, { operator }));

    const any_move = (size) => {
        const angle = any(size), [x, y] = total.turn;
        return {
            control: Array.from({ length: 2 * N }, () => any(size)),
            shift: [any(size), any(size)],
            turn: times([1 + x, y], [Math.cos(angle) - 1, Math.sin(angle)]), // a rotation after those so far
        };
    };
    const parts = (move) => ({
        control: [...move.slice(0, 2 * N)], shift: [...move.slice(2 * N, 2 * N + 2)], turn: [...move.slice(2 * N + 2)],
    });
    const is_at = (what, xy, now) => {
        near(`${what}: the wall`, xy.slice(0, 2 * NI), curves.moved(now.control).points(u), 1e-12);
        const far = ring(NJ - 1), s = [1 + now.turn[0], now.turn[1]];
        const expected = [...far].flatMap((k) => sum(sum(centre, now.shift),
            times(s, [first[2 * k] - centre[0], first[2 * k + 1] - centre[1]])));
        near(`${what}: the body`, xy.slice(2 * far[0]), expected, 1e-12);
    };
    const calls = {
        step() {
            const move = any_move(0.01);
            points = morph.morph(joined(move), { points });
            total = added(total, move);
        },
        solve() {
            morph.solve(points);
            at_start = total;
        },
        safe() {
            calls.solve();
            const found = morph.safe(joined(any_move(0.02)));
            points = found.points;
            total = added(total, parts(found.reached));
        },
        release() {
            morph.release();
        },
        // The file is attached to the mesh as it is; solve() then begins with the body where it is.
        load() {
            const file = morph.save(), move = any_move(0.01);
            morph.free();
            morph = with_mesh(points, (mesh) => hm.Morph.load(file, mesh));
            is_at("loaded", morph.morph(joined(move)), added(total, move));
            morph.solve();
            first = points;
            centre = sum(centre, total.shift);
            total = at_start = { ...total, shift: [0, 0], turn: [0, 0] };
        },
    };
    for (let k = 0; k < 6; ++k) {
        const name = one_of(Object.keys(calls));
        calls[name]();
        is_at(name, points, total);
        const since = sum(joined(total), joined(at_start).map((one) => -one));
        near(`${name}: recovered`, morph.recover(points), since, 1e-9);
        const move = joined(any_move(0.1)), force = points.map(() => any(1));
        const work = (a, b) => [a.reduce((so_far, one, i) => so_far + one * b[i], 0)];
        near(`${name}: adjoint`, work(morph.adjoint(force), move), work(morph.displacement(move), force), 1e-11);
    }
    morph.free();
}
