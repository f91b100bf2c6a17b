// Structs and constants of the C headers by name, from the table in the module (module.cpp).
import { refuse } from "./errors.js";

const SIZES = { int32: 4, int64: 8, size: 4, double: 8, char: 1, pointer: 4, function: 4 };

export class Layout {
    constructor(memory, table) {
        this.memory = memory;
        this.constants = {};
        this.structs = {};
        let struct = null;
        for (let at = table; memory.i32[at / 4] !== 0; at += 16) {
            const [name, type, value, count] = memory.i32.subarray(at / 4, at / 4 + 4);
            const key = memory.text(name);
            const word = memory.text(type);
            if (word === "constant") {
                this.constants[key] = value;
            } else if (word === "struct") {
                struct = this.structs[key] = { size: value, members: [], by_name: {} };
            } else {
                const member = { name: key, type: word, offset: value, count };
                struct.members.push(member);
                struct.by_name[key] = member;
            }
        }
    }

    size(struct) {
        return this.structs[struct].size;
    }

    /** Begins a struct at an address: struct_size, and zeros. */
    begin(struct, address) {
        const { size, members } = this.structs[struct];
        this.memory.u8.fill(0, address, address + size);
        if (members[0].name === "struct_size") this.memory.data.setInt32(address, size, true);
    }

    /** Writes members of the struct at an address. A nested struct is an object of its members. */
    write(struct, address, values) {
        for (const [name, value] of Object.entries(values)) {
            const member = this.structs[struct].by_name[name];
            if (member === undefined) refuse(`${struct} has no member ${name}.`);
            this.write_member(member, address + member.offset, value);
        }
    }

    write_member({ type }, address, value) {
        const { data } = this.memory;
        if (type === "double") data.setFloat64(address, value, true);
        else if (type === "int64") {
            data.setUint32(address, value % 2 ** 32, true);
            data.setInt32(address + 4, Math.floor(value / 2 ** 32), true);
        } else if (type in SIZES) data.setInt32(address, value, true);
        else this.write(type, address, value);
    }

    /** Reads one member; text as a string, arrays as arrays. */
    get(struct, address, name) {
        return this.read_member(this.structs[struct].by_name[name], address);
    }

    read_member({ type, offset, count }, base) {
        const address = base + offset;
        if (type === "char") return this.memory.text(address);
        if (count === 1) return this.read_one(type, address);
        const size = SIZES[type] ?? this.size(type);
        return Array.from({ length: count }, (_, k) => this.read_one(type, address + k * size));
    }

    read_one(type, address) {
        const { data } = this.memory;
        if (type === "double") return data.getFloat64(address, true);
        if (type === "int32") return data.getInt32(address, true);
        if (type === "int64") {
            return data.getInt32(address + 4, true) * 2 ** 32 + data.getUint32(address, true);
        }
        if (type in SIZES) return data.getUint32(address, true);
        return this.read(type, address);
    }

    /** Returns a copy of a struct: all members but pointers, with names as they are in JavaScript. */
    read(struct, address) {
        const result = {};
        for (const member of this.structs[struct].members) {
            const { name, type } = member;
            if (type === "pointer" || name === "struct_size" || name.startsWith("reserved")) continue;
            result[camel(name)] = this.read_member(member, address);
        }
        return result;
    }
}

function camel(name) {
    return name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
}
