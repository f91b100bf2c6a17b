"use strict";
// Numbers as text, and the little-endian numbers in base 64 of the data that the program writes.

function decode_base64(text, Numbers) {
    const characters = atob(text);
    const bytes = new Uint8Array(characters.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
    return new Numbers(bytes.buffer);
}

// Returns the number that a user has typed, with a decimal point or comma and any minus, or NaN for another text.
function number_of(text) {
    const words = text.trim().replace(",", ".").replace("−", "-");
    return words !== "" && Number.isFinite(Number(words)) ? Number(words) : NaN;
}

// Returns a number with four digits and a typographical minus.
function brief(value) {
    if (!Number.isFinite(value)) return "∞";
    return String(Number(value.toPrecision(4))).replace("-", "−");
}

// Returns "1 point", "2 points".
function plural(count, noun) {
    return `${count} ${noun}${count === 1 ? "" : "s"}`;
}

function short(value) {
    return String(Number(value.toPrecision(3)));
}
function fixed(value, digits) {
    return value
        .toFixed(digits)
        .replace("-", "−")
        .replace(/^−(0\.?0*)$/, "$1");
}
function tidy(value) {
    return String(Number(value.toPrecision(8)));
}
