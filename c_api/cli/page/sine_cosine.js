"use strict";
// The sine and the cosine of an angle [radians] up to 1e5 in magnitude, with an error of about half a unit in the last
// place: operation by operation those of basics/sine_cosine.hpp, so that a page rotates bodies by the numbers of the
// program. Math.sin has other last digits in other browsers.

function sine_cosine(angle) {
    // The sum is pi / 2; multiples of the first two numbers by n are exact.
    const parts = [0x1921fb544 * 2 ** -32, 0x10b4611a4 * 2 ** -66, 0x113198a2e03707 * 2 ** -117],
        grid = 1.5 * 2 ** 52,
        quarters = angle * 0.63661977236758138,
        n = quarters + grid - grid,
        first = angle - n * parts[0],
        second = first - n * parts[1],
        high = second - n * parts[2],
        low = first - second - n * parts[1] + (second - high - n * parts[2]),
        [s, c] = sine_cosine_near_zero(high, low),
        quarter = ((n % 4) + 4) % 4;
    return [
        [s, c],
        [c, -s],
        [-s, -c],
        [-c, s],
    ][quarter];
}

// The series for the sum high + low of at most pi/4 + 1e-9 in magnitude; low is below half a unit in the last place.
function sine_cosine_near_zero(high, low) {
    const z = high * high,
        half = z / 2,
        first = 1 - half;
    let odd = 0,
        even = 0; // the rest of the sine, and of the cosine behind two terms
    for (let k = 18; k >= 4; k -= 2) {
        even = (z / ((k + 1) * (k + 2))) * (1 - even);
        odd = (z / (k * (k + 1))) * (1 - odd);
    }
    odd = (z / 6) * (1 - odd);
    even = ((z * z) / 24) * (1 - even);
    return [high + (low * first - high * odd), first + (1 - first - half + (even - high * low))];
}
