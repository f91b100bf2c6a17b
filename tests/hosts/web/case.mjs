// The mesh and the movements of tests/release/cross/case.h, and the checksum of numbers that it defines.
export const NI = 65, NJ = 21, POINTS = NI * NJ, CONTROL = 10;

/** FNV-1a of the bits of each number, lowest byte first. */
export class Checksum {
    constructor() {
        this.sum = 14695981039346656037n;
    }

    add(numbers) {
        const bytes = new Uint8Array(Float64Array.from(numbers).buffer);
        for (const byte of bytes) this.sum = BigInt.asUintN(64, (this.sum ^ BigInt(byte)) * 1099511628211n);
        return this;
    }

    toString() {
        return this.sum.toString(16).padStart(16, "0");
    }
}

/** Rings round an ellipse; the first point of a ring is repeated at its end. Pairs x, y. */
export function points() {
    const turn_x = 0.99518472667219693, turn_y = 0.098017140329560604, xy = new Float64Array(2 * POINTS);
    let x = 1, y = 0;
    for (let i = 0; i < NI; ++i) {
        const next = x * turn_x - y * turn_y;
        if (i === NI - 1) [x, y] = [1, 0];
        for (let j = 0, r = 1; j < NJ; ++j, r *= 1.15) {
            xy[2 * (i + NI * j)] = (r + 0.5 / r) * x;
            xy[2 * (i + NI * j) + 1] = (r - 0.5 / r) * y;
        }
        y = x * turn_y + y * turn_x;
        x = next;
    }
    return xy;
}

export function triangles() {
    const list = [];
    for (let j = 0; j < NJ - 1; ++j) {
        for (let i = 0; i < NI - 1; ++i) {
            const a = i + NI * j;
            list.push(a, a + 1, a + NI + 1, a, a + NI + 1, a + NI);
        }
    }
    return Int32Array.from(list);
}

/** Runs of points; the wall has the number 1, the far field 2. */
export function boundary() {
    const ring = (j) => Int32Array.from({ length: NI }, (_, i) => i + NI * j);
    return new Map([[1, ring(0)], [2, ring(NJ - 1)]]);
}

/** A bulge: every control point moves, neighbours by nearly the same. */
export function bulge(size) {
    const move = new Float64Array(2 * CONTROL);
    for (let i = 0; i < CONTROL; ++i) {
        move[2 * i] = size * (i < CONTROL / 2 ? 0.5 - 0.1 * i : 0.1 * i - 0.5);
        move[2 * i + 1] = size * 0.04 * i * (CONTROL - i);
    }
    return move;
}

/** The coordinates x of pairs, then y, as the C program has them. */
export function columns(xy) {
    const n = xy.length / 2;
    return Float64Array.from({ length: 2 * n }, (_, k) => (k < n ? xy[2 * k] : xy[2 * (k - n) + 1]));
}
