// One instance of the module: calls with their errors, and the memory of what calls take and give.
import { HarmorphError, refuse, show } from "./errors.js";
import { Layout } from "./layout.js";
import { Memory } from "./memory.js";

// Bytes of a module that hands a function of JavaScript on as one of WebAssembly, which can stand
// in the module's table: (import "" "f" (func (param i32 i32 f64) (result i32))) (export "f" ...)
const BRIDGE = [
    0, 97, 115, 109, 1, 0, 0, 0, 1, 8, 1, 96, 3, 127, 127, 124, 1, 127, 2, 6, 1, 0, 1, 102, 0, 0, 7, 5,
    1, 1, 102, 0, 0,
];

export class Library {
    constructor(instance, kernel, onWarning) {
        this.exports = instance.exports;
        this.kernel = kernel;
        this.onWarning = onWarning;
        this.memory = new Memory(this.exports);
        this.layout = new Layout(this.memory, this.exports.hm_web_layout());
        this.constants = this.layout.constants;
        this.error = this.memory.allocate(this.layout.size("hm_error"));
        this.kinds = {};
        for (const [name, value] of Object.entries(this.constants)) {
            if (name.startsWith("HM_ITEM_") && value !== 0) {
                this.kinds[value] = name.slice("HM_ITEM_".length).toLowerCase().replaceAll("_", " ");
            }
        }
        this.progress = null;
        this.progress_function = 0;
        this.registry = new FinalizationRegistry((scope) => scope.release());
    }

    get version() {
        return this.memory.text(this.exports.hm_version());
    }

    /** Calls a function of the library; the error is its last argument. Throws, or warns. */
    call(name, ...values) {
        const call = this.exports[name];
        if (call.length !== values.length + 1) throw new TypeError(`${name} takes ${call.length} arguments`);
        const status = call(...values, this.error);
        if (status === 0) return status;
        const finding = this.finding(status);
        if (status < 0) throw this.stopped ?? finding;
        this.onWarning?.(finding);
        return status;
    }

    finding(status) {
        const found = this.layout.read("hm_error", this.error);
        const item = (kind, number, base) =>
            kind in this.kinds ? [this.kinds[kind], number - base] : [null, null];
        const [kind, first] = item(found.itemKind, found.item, found.itemBase);
        const [otherKind, other] = item(found.otherKind, found.other, found.otherBase);
        const code = this.memory.text(this.exports.hm_status_name(status));
        const { value, x, y } = found;
        return new HarmorphError(found.text, { code, kind, item: first, otherKind, other, value, x, y });
    }

    /** Runs the body with a scope whose memory is given back afterwards. */
    with(body) {
        const scope = new Scope(this);
        try {
            return body(scope);
        } finally {
            scope.release();
        }
    }

    /** Runs the body while `progress` is told of phases; what it returns as false stops the call. */
    with_progress(progress, body) {
        if (progress === undefined || progress === null) return body(0);
        if (typeof progress !== "function") refuse(`progress must be a function, not ${show(progress)}.`);
        const before = this.progress;
        this.progress = progress;
        try {
            return body(this.callback());
        } finally {
            this.progress = before;
            this.stopped = undefined;
        }
    }

    // Returns the place in the module's table of the function that calls this.progress. What that
    // throws must not pass through the module, whose stack would stay as it was.
    callback() {
        if (this.progress_function !== 0) return this.progress_function;
        const f = (_user, phase, fraction) => {
            try {
                return this.progress?.(this.phase(phase), fraction) === false ? 1 : 0;
            } catch (error) {
                this.stopped = error;
                return 1;
            }
        };
        const bridge = new WebAssembly.Instance(new WebAssembly.Module(new Uint8Array(BRIDGE)), { "": { f } });
        const table = this.exports.__indirect_function_table;
        this.progress_function = table.grow(1);
        table.set(this.progress_function, bridge.exports.f);
        return this.progress_function;
    }

    phase(number) {
        const found = Object.entries(this.constants).find(
            ([name, value]) => name.startsWith("HM_PHASE_") && value === number);
        return found === undefined ? "" : found[0].slice("HM_PHASE_".length).toLowerCase().replaceAll("_", " ");
    }
}

// Blocks of memory that are given back together: those of one call, or those of an object.
export class Scope {
    constructor(library) {
        this.library = library;
        this.blocks = [];
        this.outputs = [];
    }

    release() {
        for (const block of this.blocks) this.library.memory.free(block);
        this.blocks = [];
    }

    take(bytes) {
        const block = this.library.memory.allocate(bytes);
        this.blocks.push(block);
        return block;
    }

    /** Gives the last block back, where it was needed for a while only. */
    drop(block) {
        this.blocks.splice(this.blocks.indexOf(block), 1);
        this.library.memory.free(block);
    }

    /** Makes a struct with these members, the others 0. */
    struct(name, values = {}) {
        const address = this.take(this.library.layout.size(name));
        this.library.layout.begin(name, address);
        this.library.layout.write(name, address, values);
        return address;
    }

    /** Makes an array of structs. */
    structs(name, list) {
        const size = this.library.layout.size(name);
        const address = this.take(size * Math.max(1, list.length));
        list.forEach((values, k) => {
            this.library.layout.begin(name, address + k * size);
            this.library.layout.write(name, address + k * size, values);
        });
        return address;
    }

    // ---- Arrays that are read ----

    /** Returns the address of a copy of a Float64Array or an Int32Array. */
    copied(array) {
        const { memory } = this.library;
        const address = this.take(array.byteLength);
        const is_whole = array instanceof Int32Array, n = array.length;
        (is_whole ? memory.integers(address, n) : memory.numbers(address, n)).set(array);
        return address;
    }

    /** Returns the address of n numbers: where they are, if they are in the memory; else of a copy. */
    numbers(given, n, what) {
        const { memory } = this.library;
        const values = floats(given, what);
        if (n !== undefined && values.length !== n) {
            refuse(`${what} must have ${n} numbers, not ${values.length}.`);
        }
        if (memory.holds(values)) return values.byteOffset;
        const address = this.take(8 * values.length);
        memory.numbers(address, values.length).set(values);
        return address;
    }

    integers(given, n, what) {
        const { memory } = this.library;
        const values = ints(given, what);
        if (n !== undefined && values.length !== n) {
            refuse(`${what} must have ${n} whole numbers, not ${values.length}.`);
        }
        if (memory.holds(values)) return values.byteOffset;
        const address = this.take(4 * values.length);
        memory.integers(address, values.length).set(values);
        return address;
    }

    /** Returns hm_points of n points, given as pairs x, y, x, y, ...; 0 for undefined and null. */
    points(given, n, what) {
        if (given === undefined || given === null) return 0;
        return this.struct("hm_points", pairs(this.numbers(given, 2 * n, what)));
    }

    // ---- Arrays that are written ----

    /** Returns the address of n numbers that the call writes into `out`, a new array if not given. */
    numbers_out(out, n, what = "out") {
        const array = out === undefined || out === null ? new Float64Array(n) : floats(out, what);
        if (!(out === undefined || out === null) && Array.isArray(out)) {
            refuse(`${what} must be a Float64Array or Numbers.`);
        }
        if (array.length !== n) refuse(`${what} must have ${n} numbers, not ${array.length}.`);
        const { memory } = this.library;
        if (memory.holds(array)) return { address: array.byteOffset, done: () => out };
        const address = this.take(8 * n);
        return {
            address,
            done: () => {
                array.set(this.library.memory.numbers(address, n));
                return out ?? array;
            },
        };
    }

    points_out(out, n, what = "out") {
        const { address, done } = this.numbers_out(out, 2 * n, what);
        return { address, points: this.struct("hm_points_out", pairs(address)), done };
    }

    // ---- Sizes and blocks ----

    /** Makes a call twice, with an hm_memory: for its size, and with a block, which the scope keeps. */
    with_memory(call) {
        const { layout } = this.library, memory = this.struct("hm_memory");
        let block = 0;
        try {
            call(memory);
            block = this.take(layout.get("hm_memory", memory, "bytes"));
            layout.write("hm_memory", memory, { block });
            call(memory);
        } catch (error) {
            if (block !== 0) this.drop(block);
            throw error;
        } finally {
            this.drop(memory);
        }
    }

    /** Makes an object of the library in a block of its own and returns its address. */
    object(name, ...values) {
        const { library } = this, slot = this.take(4);
        try {
            this.with_memory((memory) => library.call(name, slot, memory, ...values));
            return library.memory.data.getUint32(slot, true);
        } finally {
            this.drop(slot);
        }
    }
}

function pairs(address) {
    return { x: address, y: address + 8, stride: 2 };
}

// Numbers are Numbers of this package, a Float64Array, another typed array or a plain array.
function floats(given, what) {
    const values = given?.view ?? given;
    if (values instanceof Float64Array) return values;
    if (ArrayBuffer.isView(values) && typeof values.length === "number" && typeof values[0] !== "bigint") {
        return Float64Array.from(values);
    }
    if (Array.isArray(values) && values.every((one) => typeof one === "number")) return Float64Array.from(values);
    return refuse(`${what} must be numbers, for instance a Float64Array, not ${show(given)}.`);
}

function ints(given, what) {
    if (given instanceof Int32Array) return given;
    const is_list = Array.isArray(given) || (ArrayBuffer.isView(given) && typeof given.length === "number");
    if (!is_list) refuse(`${what} must be whole numbers, for instance an Int32Array, not ${show(given)}.`);
    for (let k = 0; k < given.length; ++k) {
        if (!Number.isInteger(given[k]) || given[k] < -(2 ** 31) || given[k] >= 2 ** 31) {
            refuse(`Entry ${k} of ${what} must be a whole number of 32 bits, not ${show(given[k])}.`);
        }
    }
    return Int32Array.from(given);
}

/** Base of the classes that load() returns: each of them has the static member `library`. */
export class Owner {
    get library() {
        return this.constructor.library;
    }

    // Makes the scope that is released by free(), or when the object is collected.
    own() {
        const scope = new Scope(this.library);
        this.library.registry.register(this, scope, scope);
        return scope;
    }

    disown(scope) {
        if (scope === null) return null;
        this.library.registry.unregister(scope);
        scope.release();
        return null;
    }
}

// `using` exists in newer engines only; objects have the method where the symbol does.
export function disposable(type) {
    if (Symbol.dispose !== undefined) {
        type.prototype[Symbol.dispose] = function dispose() {
            this.free();
        };
    }
}
