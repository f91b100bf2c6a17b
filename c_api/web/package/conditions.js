// What the points of each marker do.
import { choice, pair, refuse, show, whole } from "./errors.js";

const KINDS = {
    curve: "HM_ON_CURVE", rigid: "HM_RIGID", fixed: "HM_FIXED", slip: "HM_SLIP", free: "HM_FREE",
    periodic: "HM_PERIODIC_PAIR", given: "HM_GIVEN", rotation: "HM_ROTATION_PAIR", interface: "HM_INTERFACE",
};

/**
  * Returns [marker, condition] for conditions by marker: an object, a Map or an array of such pairs.
  * Markers that the curves were fitted to are on the curves if they are not among them.
  */
export function listed(mesh, curves, given) {
    if (typeof given !== "object" || given === null) {
        refuse("conditions must be an object, a Map or an array of pairs.");
    }
    const pairs = Array.isArray(given) || given instanceof Map ? [...given] : Object.entries(given);
    const named = new Set(pairs.map((one) => one?.[0]));
    const fitted = (curves?.markers ?? []).filter((name) => !named.has(name)).map((name) => [name, "curve"]);
    const result = [...fitted, ...pairs].map((one) => {
        if (!Array.isArray(one) || one.length !== 2) refuse("A condition is a pair of a marker and its condition.");
        const condition = typeof one[1] === "string" ? { kind: one[1] } : one[1];
        choice(KINDS, condition?.kind, `The condition of marker ${show(one[0])}`, "HM_BAD_CONDITION");
        return [mesh.marker(one[0]), condition];
    });
    if (result.length === 0) {
        refuse("No marker is on a curve, rigid or given; give conditions, or curves that were fitted to markers.",
            "HM_BAD_CONDITION");
    }
    return result;
}

/** Returns the pairs with which a basis was solved. */
export function of_basis(library, mesh, basis, Curves) {
    const kinds = Object.fromEntries(Object.entries(KINDS).map(([word, name]) => [library.constants[name], word]));
    const names = new Map([...mesh.markers].map(([name, number]) => [number, name]));
    const { layout, memory } = library, size = layout.size("hm_condition");
    return library.with((scope) => {
        const n = scope.take(4);
        for (let room = 16; ; room = memory.data.getInt32(n, true)) {
            const list = scope.structs("hm_condition", Array.from({ length: room }, () => ({})));
            try {
                library.call("hm_basis_conditions", basis, list, room, n);
            } catch (error) {
                if (memory.data.getInt32(n, true) > room) continue;
                throw error;
            }
            return Array.from({ length: memory.data.getInt32(n, true) }, (_, k) => {
                const found = layout.read("hm_condition", list + k * size), condition = { kind: kinds[found.kind] };
                if (condition.kind === "curve") condition.curves = [found.firstCurve, found.nCurves];
                if (condition.kind === "slip" && found.nCurves > 0) {
                    condition.along = Curves.of_basis("hm_basis_along", found.nCurves, basis, k);
                }
                if (["periodic", "rotation", "interface"].includes(condition.kind)) {
                    condition.partner = names.get(found.partner);
                }
                if (found.piece !== 0) condition.near = [found.nearX, found.nearY];
                return [found.marker, { ...condition, body: found.body, centre: [found.x, found.y] }];
            });
        }
    });
}

/** Returns the pairs with the centres of rigid bodies translated; moves: four numbers for each body. */
export function with_moved_centres(pairs, moves) {
    return pairs.map(([marker, condition]) => {
        if (condition.kind !== "rigid") return [marker, condition];
        const { body, centre: [x, y] } = condition;
        return [marker, { ...condition, centre: [x + moves[4 * body], y + moves[4 * body + 1]] }];
    });
}

/** Writes an array of hm_condition into a scope and returns the address. */
export function describe(scope, mesh, curves, pairs) {
    const alongs = new Map(); // conditions along the same curves share them, so that points slip on
    return scope.structs("hm_condition", pairs.map(([marker, condition]) => {
        const members = { marker, kind: scope.library.constants[KINDS[condition.kind]] };
        if (condition.kind === "curve" && curves !== null) {
            [members.first_curve, members.n_curves] = pair(condition.curves ?? [0, curves.curves.length], "curves");
        }
        if (condition.partner !== undefined) members.partner = mesh.marker(condition.partner);
        if (condition.body !== undefined) members.body = whole(condition.body, "body");
        if (condition.centre !== undefined) [members.x, members.y] = pair(condition.centre, "centre");
        if (condition.near !== undefined) {
            members.piece = 1;
            [members.near_x, members.near_y] = pair(condition.near, "near");
        }
        if (condition.along !== undefined) {
            if (typeof condition.along?.describe !== "function") refuse("along must be Curves.", "HM_BAD_CONDITION");
            if (!alongs.has(condition.along)) alongs.set(condition.along, condition.along.describe(scope));
            members.along = alongs.get(condition.along);
            members.n_curves = condition.along.curves.length;
        }
        return members;
    }));
}
