// Damaged mesh files, the same in each run.

// Numbers between 0 and 1 (Park and Miller).
export const numbers = (seed) => () => (seed = (seed * 16807) % 2147483647) / 2147483647;

const WORDS = ["-1", "1e999", "nan", "99999999999999999999", "0", "<script>alert(1)</script>", "\u0000", "'\"`",
    "NELEM= 2000000000", "%", "$EndNodes", "</DataArray>", "MARKER_TAG= <img src=x onerror=alert(1)>", "\u00ff\u00fe"];

// Returns the bytes of a file with one kind of damage: it ends early, bytes are others, lines are missing, doubled or
// have another word, or all of it is noise.
export function damaged(bytes, random) {
    const at = (n) => Math.floor(n * random()),
        kind = at(6);
    if (kind === 0) return bytes.slice(0, at(bytes.length));
    if (kind === 1) {
        const other = bytes.slice();
        for (let k = 0; k < 1 + at(20); ++k) other[at(other.length)] = at(256);
        return other;
    }
    if (kind === 5) return Uint8Array.from({ length: 1 + at(3000) }, () => at(256));
    const lines = Buffer.from(bytes).toString("latin1").split("\n"),
        line = random() < 0.5 ? at(lines.length) : at(Math.min(12, lines.length));
    if (kind === 2) lines.splice(line, 1 + at(5));
    if (kind === 3) lines.splice(line, 0, ...lines.slice(line, line + 1 + at(50)));
    if (kind === 4) {
        const words = lines[line].split(" ");
        words[at(words.length)] = WORDS[at(WORDS.length)];
        lines[line] = words.join(" ");
    }
    return new Uint8Array(Buffer.from(lines.join("\n"), "latin1"));
}
