"use strict";
// Numbers as text.

// Four digits for people, and a proper minus.
function brief(value) {
    if (!Number.isFinite(value)) return "∞";
    return String(Number(value.toPrecision(4))).replace("-", "−");
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
