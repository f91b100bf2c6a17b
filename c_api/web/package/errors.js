// What the library says about a call: a refusal is thrown, a reservation is handed to onWarning.

/** A call was refused; outputs are as before the call. index.d.ts describes the fields. */
export class HarmorphError extends Error {
    constructor(message, fields = {}) {
        super(message);
        this.name = "HarmorphError";
        this.code = "HM_BAD_ARGUMENT";
        this.kind = this.otherKind = null;
        this.item = this.other = null;
        this.value = this.x = this.y = 0;
        Object.assign(this, fields);
    }
}

/** Refuses an argument before the library is called. */
export function refuse(message, code = "HM_BAD_ARGUMENT", fields = {}) {
    throw new HarmorphError(message, { code, ...fields });
}

/** Returns the value of `name` in a table of words, or refuses a word that is not there. */
export function choice(table, name, what, code) {
    if (typeof name === "string" && Object.hasOwn(table, name)) return table[name];
    return refuse(`${what} must be one of ${Object.keys(table).join(", ")}, not ${show(name)}.`, code);
}

/** Returns a value of any type as a short text for a message. */
export function show(value) {
    if (typeof value === "string") return JSON.stringify(value.slice(0, 60));
    if (typeof value !== "object" || value === null) return String(value).slice(0, 60);
    if (ArrayBuffer.isView(value) || Array.isArray(value)) return `an array of length ${value.length}`;
    return "an object";
}

/** Returns a whole number between the limits, or refuses the value. */
export function whole(value, what, low = -(2 ** 31), high = 2 ** 31 - 1) {
    if (Number.isInteger(value) && value >= low && value <= high) return value;
    return refuse(`${what} must be a whole number from ${low} to ${high}, not ${show(value)}.`);
}

/** Returns a number, or refuses the value; the library judges infinity and NaN. */
export function number(value, what) {
    return typeof value === "number" ? value : refuse(`${what} must be a number, not ${show(value)}.`);
}

/** Returns a pair of numbers, or refuses the value. */
export function pair(value, what) {
    if (typeof value !== "object" || value === null || value.length !== 2) {
        refuse(`${what} must be two numbers, not ${show(value)}.`);
    }
    return [number(value[0], what), number(value[1], what)];
}
