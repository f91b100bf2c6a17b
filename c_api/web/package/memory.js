// The memory of the module: blocks are taken and given back, and the memory grows where none fits.
import { HarmorphError } from "./errors.js";

const PAGE = 65536;
const LIMIT = 65536 * PAGE;
const ALIGNMENT = 64;

export class Memory {
    // `exports` are those of the module; the memory is free from __heap_base on.
    constructor(exports) {
        this.memory = exports.memory;
        const first = exports.__heap_base.value;
        this.base = Math.ceil(first / ALIGNMENT) * ALIGNMENT;
        this.used = new Map(); // address: bytes
        // Free ranges [start, end), sorted, never adjacent to each other.
        this.free_ranges = [[this.base, this.memory.buffer.byteLength]];
        this.bytes_in_use = 0;
        this.refresh();
    }

    // Views of the whole memory. They are made anew where the memory has grown.
    refresh() {
        const buffer = this.memory.buffer;
        this.data = new DataView(buffer);
        this.u8 = new Uint8Array(buffer);
        this.i32 = new Int32Array(buffer);
        this.f64 = new Float64Array(buffer);
    }

    /** Returns the address of a block, a multiple of 64; refuses what 4 GiB cannot hold. */
    allocate(bytes) {
        const size = Math.max(1, Math.ceil(bytes / ALIGNMENT)) * ALIGNMENT;
        let range = this.free_ranges.find(([start, end]) => end - start >= size);
        if (range === undefined) range = this.grow(size, bytes);
        const address = range[0];
        range[0] += size;
        if (range[0] === range[1]) this.free_ranges.splice(this.free_ranges.indexOf(range), 1);
        this.used.set(address, size);
        this.bytes_in_use += size;
        return address;
    }

    // Makes the last free range at least `size` bytes long and returns it. The memory grows by at
    // least an eighth, so that many small blocks do not grow it many times.
    grow(size, wanted) {
        const end = this.memory.buffer.byteLength;
        const last = this.free_ranges.at(-1);
        const start = last !== undefined && last[1] === end ? last[0] : end;
        const missing = Math.ceil((start + size - end) / PAGE);
        const ample = Math.max(missing, Math.ceil(end / PAGE / 8));
        if (!this.try_to_grow(ample, end) && !this.try_to_grow(missing, end)) {
            const message =
                `${wanted} more bytes are needed, beside ${this.bytes_in_use} that are in use; the memory of ` +
                `WebAssembly has at most ${LIMIT} bytes, and this machine may give less.`;
            throw new HarmorphError(message, { code: "HM_BLOCK_TOO_SMALL", value: wanted });
        }
        const range = [start, this.memory.buffer.byteLength];
        if (start === end) this.free_ranges.push(range);
        else this.free_ranges[this.free_ranges.length - 1] = range;
        return range;
    }

    try_to_grow(pages, end) {
        if (end + pages * PAGE > LIMIT) return false;
        try {
            this.memory.grow(pages);
        } catch {
            return false;
        }
        this.refresh();
        return true;
    }

    /** Gives a block back. */
    free(address) {
        const size = this.used.get(address);
        if (size === undefined) return;
        this.used.delete(address);
        this.bytes_in_use -= size;
        const ranges = this.free_ranges;
        let at = ranges.findIndex(([start]) => start > address);
        if (at === -1) at = ranges.length;
        ranges.splice(at, 0, [address, address + size]);
        if (at + 1 < ranges.length && ranges[at][1] === ranges[at + 1][0]) {
            ranges[at][1] = ranges[at + 1][1];
            ranges.splice(at + 1, 1);
        }
        if (at > 0 && ranges[at - 1][1] === ranges[at][0]) {
            ranges[at - 1][1] = ranges[at][1];
            ranges.splice(at, 1);
        }
    }

    /** Returns a view of n numbers at an address; the view ends when the memory grows. */
    numbers(address, n) {
        return this.f64.subarray(address / 8, address / 8 + n);
    }

    integers(address, n) {
        return this.i32.subarray(address / 4, address / 4 + n);
    }

    text(address) {
        const end = this.u8.indexOf(0, address);
        return new TextDecoder().decode(this.u8.subarray(address, end));
    }

    /** Returns whether an array is a view of this memory as it is now. */
    holds(array) {
        return array.buffer === this.memory.buffer;
    }
}
