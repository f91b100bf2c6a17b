// The quality of a mesh as smooth constraints of an optimiser, with derivatives by the mesh points.
import { choice, number, refuse } from "./errors.js";
import { disposable, Owner } from "./library.js";
import { Morph } from "./morph.js";

const KINDS = { quality: "HM_BOUND_QUALITY", keptQuality: "HM_BOUND_KEPT_QUALITY", area: "HM_BOUND_AREA",
    height: "HM_BOUND_HEIGHT", stretch: "HM_BOUND_STRETCH", angle: "HM_BOUND_ANGLE" };

/** The mesh of a morph at its start, with which moved meshes are compared. */
export class Quality extends Owner {
    constructor(morph) {
        super();
        if (!(morph instanceof Morph)) refuse("The argument must be a Morph.");
        const basis = morph.open();
        if (morph.problem === null) refuse("This call needs the mesh; give it to Morph.load().", "HM_BAD_BASIS");
        this.morph = morph;
        this.nPoints = morph.nPoints;
        this.scope = this.own();
        try {
            this.address = this.scope.object("hm_quality_init", basis, morph.problem.address, 0);
            this.basis = basis;
        } catch (error) {
            this.free();
            throw error;
        }
    }

    // The object reads the basis and the cells of the morph.
    open() {
        if (this.scope === null) refuse("This object was freed.");
        if (this.morph.open() !== this.basis) {
            refuse("The functions were solved again; make a new Quality.", "HM_BAD_BASIS");
        }
        return this.address;
    }

    /** Computes smooth bounds, named by kind or { kind, sharpness }, and their derivatives. */
    bounds(kinds, { points, gradients = true } = {}) {
        const address = this.open(), list = Array.isArray(kinds) ? kinds : [kinds];
        return this.library.with((scope) => {
            const { layout, constants } = this.library, n = list.length;
            const bounds = scope.structs("hm_bound", list.map((one) => {
                const { kind, sharpness = 0 } = typeof one === "string" ? { kind: one } : one ?? {};
                return { kind: constants[choice(KINDS, kind, "A bound")], sharpness: number(sharpness, "sharpness") };
            }));
            const values = scope.structs("hm_bound_value", list.map(() => ({})));
            const slopes = gradients ? list.map(() => scope.numbers_out(null, 2 * this.nPoints)) : [];
            const out = scope.structs("hm_points_out", slopes.map(({ address: x }) => ({ x, y: x + 8, stride: 2 })));
            const at = scope.points(points, this.nPoints, "points");
            this.library.call("hm_quality_bounds", address, at, n, bounds, values, gradients ? out : 0, 0);
            return list.map((_, k) => {
                const { bound, extreme, item } =
                    layout.read("hm_bound_value", values + k * layout.size("hm_bound_value"));
                return { value: bound, extreme, item, gradient: gradients ? slopes[k].done() : null };
            });
        });
    }

    /** Returns the corners that limit the admissible step, with the derivatives of their steps. */
    corners(displacement, { points, closeness = 1e-10 } = {}) {
        this.open();
        return this.library.with((scope) => {
            const { layout, memory } = this.library, n = this.nPoints, count = scope.take(4);
            const from = scope.points(points, n, "points"), by = scope.points(displacement ?? [], n, "displacement");
            for (let room = 16; ; room = memory.data.getInt32(count, true)) {
                const corners = scope.take(room * layout.size("hm_step_corner"));
                this.library.call("hm_step_gradient", this.basis, this.morph.problem.address, from, by,
                    number(closeness, "closeness"), room, corners, count, 0);
                const found = memory.data.getInt32(count, true);
                if (found > room) continue;
                return Array.from({ length: found }, (_, k) => {
                    const { step, cell, points: three, byFrom } =
                        layout.read("hm_step_corner", corners + k * layout.size("hm_step_corner"));
                    return { step, cell, points: three, byPoints: Float64Array.from(byFrom) };
                });
            }
        });
    }

    free() {
        this.scope = this.disown(this.scope);
    }
}
disposable(Quality);
