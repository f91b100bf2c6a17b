"use strict";
// Pairs of control points that lie on opposite sides of the chord of a section, and may move together.

class Pairs {
    constructor(data, sections) {
        this.partner = new Int32Array(data.n_control).fill(-1);
        this.frame = []; // the chord frame of the section of each control point
        for (const section of sections) {
            const at = new Map(
                section.control.map((i) => [
                    i,
                    section.in_chords(section.frame, data.control[2 * i], data.control[2 * i + 1]),
                ]),
            );
            const nearest = (i) => {
                let best = -1,
                    least = 0.1; // [chords]
                for (const j of section.control) {
                    if (!(at.get(i)[1] * at.get(j)[1] < 0)) continue;
                    const distance =
                        Math.abs(at.get(i)[0] - at.get(j)[0]) + 0.5 * Math.abs(at.get(i)[1] + at.get(j)[1]);
                    if (distance < least) [best, least] = [j, distance];
                }
                return best;
            };
            for (const i of section.control) {
                this.frame[i] = section.frame;
                const j = nearest(i);
                if (j >= 0 && nearest(j) === i) this.partner[i] = j;
            }
        }
    }

    // Returns the movement of the partner of a point that moves by dx, dy; mode is "mirror" (thickness) or "along"
    // (camber).
    partner_moves(mode, index, dx, dy) {
        if (mode === "along") return [dx, dy];
        const { tx, ty } = this.frame[index],
            dt = dx * tx + dy * ty,
            dn = dy * tx - dx * ty;
        return [dt * tx + dn * ty, dt * ty - dn * tx];
    }
}
