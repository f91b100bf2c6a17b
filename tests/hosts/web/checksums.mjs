// usage: node checksums.mjs PACKAGE KERNEL   Prints the lines of tests/release/cross/morphs.c, computed by the package;
// browser.mjs calls run() in Chromium.
import { boundary, bulge, Checksum, columns, CONTROL, NI, NJ, points, triangles } from "./case.mjs";

const METHODS = [
    ["conformal", { operator: "conformal" }, true],
    ["Laplace", { operator: "laplace" }, false],
    ["weighted", { operator: "weighted" }, false],
    ["bounded", { operator: "laplace", scheme: "bounded" }, true],
    ["nodal gradients", { operator: "laplace", scheme: "nodalGradient" }, false],
    ["multigrid", { operator: "laplace", engine: "multigrid" }, false],
    ["FAS", { operator: "laplace", engine: "fas" }, false],
];
const XY = points();

function use(morph) {
    const sum = new Checksum(), move = bulge(0.2);
    const displacement = morph.displacement(move);
    sum.add(columns(displacement));
    const { admissible } = morph.assess(displacement).step;
    sum.add([admissible]);
    sum.add(morph.adjoint(displacement));
    return sum.add(columns(morph.morph(move.map((one) => one * (admissible < 2 ? 0.5 * admissible : 1)))));
}

export async function run(load, [kernel], say) {
    const hm = await load({ kernel });
    for (const [name, cells] of [["quadrilaterals", { ni: NI, nj: NJ }], ["triangles", { triangles: triangles() }]]) {
        const curves = hm.Curves.fitPoints(XY.slice(0, 2 * (NI - 1)), true, { nControl: CONTROL, closed: "periodic" });
        say(`${name}, cubic, fit: ${new Checksum().add(curves.control)}`);
        const mesh = new hm.Mesh(XY, cells, boundary());
        for (const [method, options, is_safe] of METHODS) {
            const morph = new hm.Morph(mesh, curves, new Map([[1, "curve"]]), options);
            say(`${name}, ${method}, morph: ${use(morph)}`);
            if (is_safe) {
                const moved = morph.safe(bulge(1)).points;
                const { meanQuality } = morph.assess(null, { points: moved, reference: XY }).quality;
                say(`${name}, ${method}, safe morph: ${new Checksum().add(columns(moved)).add([meanQuality])}`);
            }
            morph.free();
        }
        mesh.free();
    }
}

if (typeof process === "object") {
    const { load } = await import(process.argv[2]);
    await run(load, process.argv.slice(3), console.log);
}
