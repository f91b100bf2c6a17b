// The classes of one instance of the module.
import { Curves } from "./curves.js";
import { HarmorphError } from "./errors.js";
import { Library } from "./library.js";
import { Mesh } from "./mesh.js";
import { Morph } from "./morph.js";
import { Numbers } from "./numbers.js";
import { Quality } from "./quality.js";

/** Returns the classes of an instance of the module. */
export function bind(instance, kernel, onWarning = warn) {
    const library = new Library(instance, kernel, onWarning);
    const bound = { kernel, version: library.version };
    for (const type of [Mesh, Curves, Morph, Quality, Numbers]) {
        bound[type.name] = { [type.name]: class extends type { static library = library; } }[type.name];
    }
    Object.defineProperty(bound, "bytesInUse", { get: () => library.memory.bytes_in_use, enumerable: true });
    Object.defineProperty(bound, "memory", { get: () => library.memory.memory, enumerable: true });
    bound.HarmorphError = HarmorphError;
    library.bound = bound;
    return bound;
}

export function warn(finding) {
    console.warn(`${finding.code}: ${finding.message}`);
}
