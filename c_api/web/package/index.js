// harmorph as WebAssembly: load() instantiates the library and returns the classes of that instance.
import { bind, warn } from "./bound.js";
import { Curves } from "./curves.js";
import { HarmorphError, refuse } from "./errors.js";
import { Mesh } from "./mesh.js";
import { Morph } from "./morph.js";
import { Numbers } from "./numbers.js";
import { Quality } from "./quality.js";

export { Curves, HarmorphError, Mesh, Morph, Numbers, Quality };

const FILES = { baseline: "harmorph.wasm", simd128: "harmorph_simd128.wasm" };

// A module with one instruction of simd128; engines without these instructions refuse it.
const SIMD128 = [
    0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11,
];

/** Loads the library; see index.d.ts. */
export async function load({ kernel = "auto", module, onWarning = warn } = {}) {
    if (kernel !== "auto" && !Object.hasOwn(FILES, kernel)) {
        refuse(`kernel must be auto, ${Object.keys(FILES).join(" or ")}.`);
    }
    const has_simd = WebAssembly.validate(new Uint8Array(SIMD128));
    const chosen = kernel === "auto" ? (has_simd ? "simd128" : "baseline") : kernel;
    const compiled = module === undefined ? await compile(new URL(FILES[chosen], import.meta.url))
        : module instanceof WebAssembly.Module ? module : await WebAssembly.compile(module);
    return bind(await WebAssembly.instantiate(compiled), module === undefined ? chosen : "given", onWarning);
}

async function compile(url) {
    if (url.protocol === "file:" && typeof process === "object") {
        const node = "node:fs/promises"; // in a variable, so that bundlers for browsers do not look for it
        const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ node);
        return WebAssembly.compile(await readFile(url));
    }
    const response = await fetch(url);
    if (!response.ok) refuse(`${url} cannot be loaded: ${response.status}.`);
    return WebAssembly.compile(await response.arrayBuffer());
}
