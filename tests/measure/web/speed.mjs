// usage: node speed.mjs PACKAGE KERNEL NI NJ CONTROL   Prints the lines of speed.c for WebAssembly; browser.mjs of
// tests/hosts/web calls run() in Chromium.

// Each part is repeated until it has taken 2 s, three times at least; the shortest time counts. The clock of a browser
// has steps of 0.1 ms, so that parts that are shorter than 5 ms are repeated between two looks at the clock.
function shortest(body) {
    let best = Infinity, all = 0, calls = 1;
    for (let runs = 0; runs < 3 || (all < 2000 && runs < 200); ++runs) {
        const begun = performance.now();
        for (let k = 0; k < calls; ++k) body();
        const took = performance.now() - begun;
        all += took;
        if (took < 5) calls *= 2;
        else best = Math.min(best, took / calls);
    }
    return best;
}

export async function run(load, [kernel, ...sizes], say) {
    const hm = await load({ kernel }), [ni, nj, n_control] = sizes.map(Number);
    const n = ni * nj, xy = new Float64Array(2 * n), move = new Float64Array(2 * n_control);
    for (let j = 0; j < nj; ++j) {
        const r = Math.exp(3 * j / (nj - 1));
        for (let i = 0; i < ni; ++i) {
            const angle = 2 * Math.PI * (i % (ni - 1)) / (ni - 1);
            xy[2 * (i + ni * j)] = (r + 0.6 / r) * Math.cos(angle);
            xy[2 * (i + ni * j) + 1] = (r - 0.6 / r) * Math.sin(angle);
        }
    }
    const ring = (j) => Int32Array.from({ length: ni }, (_, i) => i + ni * j);
    const mesh = new hm.Mesh(xy, { ni, nj }, new Map([[1, ring(0)], [2, ring(nj - 1)]]));
    const curves = hm.Curves.fit(mesh, 1, { nControl: n_control, closed: "periodic" });
    for (let i = 0; i < n_control; ++i) move[2 * i + 1] = 0.01 * (i % 3);
    const morph = new hm.Morph(mesh, curves), moved = new hm.Numbers(2 * n);
    const part = (name, body) => say(`${name} ${shortest(body).toFixed(4)}`);
    part("analysis", () => {
        morph.release();
        morph.solver = morph.make_solver();
    });
    part("factor", () => {
        morph.solver.has_factor = false;
        morph.ready();
    });
    part("solution", () => morph.library.call("hm_plan_solve", morph.solver.plan, morph.basis.address, 0));
    part("morph", () => morph.displacement(move, { out: moved }));
    part("adjoint", () => morph.adjoint(moved));
    part("assessment", () => morph.assess(moved));
    morph.free();
    part("together", () => new hm.Morph(mesh, curves).free());
}

if (typeof process === "object") {
    const { load } = await import(process.argv[2]);
    await run(load, process.argv.slice(3), console.log);
}
