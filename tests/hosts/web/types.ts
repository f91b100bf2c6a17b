// What a program in TypeScript writes; compiled only. A line behind @ts-expect-error must be refused.
import { load, HarmorphError, type Harmorph, type QualityReport, type SafeReport } from "harmorph";

const hm: Harmorph = await load({ kernel: "simd128", onWarning: (finding: HarmorphError) => void finding.code });
const mesh = new hm.Mesh(new Float64Array(18), { ni: 3, nj: 3 }, { all: [0, 1, 2, 5, 8, 7, 6, 3, 0] });
const curves = hm.Curves.fit(mesh, ["all"], { nControl: 8, closed: "periodic" });
const morph = new hm.Morph(mesh, curves, { all: { kind: "curve", curves: [0, 1] } }, { operator: "laplace" });
const out = new hm.Numbers(2 * morph.nPoints);
const quality: QualityReport = morph.assess(morph.displacement([0, 0], { out })).quality;
const safe: SafeReport = morph.safe(new Float64Array(16), { skip: ["other"] }).report;
const area: number = curves.measure(["area", { kind: "thickness", station: 0.3 }]).values[0];
const bound: number = new hm.Quality(morph).bounds({ kind: "area", sharpness: 100 })[0].value;
export const all: number[] = [quality.minQuality, safe.stepFraction, area, bound, safe.worst[0].quality];
// @ts-expect-error
morph.displacement("move");
// @ts-expect-error
new hm.Morph(mesh, curves, { all: "elastic" });
