"use strict";
// The curvature comb shows the curvature of B-spline curves as teeth at right angles to them. The length of a tooth is
// the square root of the curvature, so that teeth at the leading edge and along the sides are visible together; a
// positive curvature, of a curve that turns to the left, has its teeth on the right.

class Comb {
    // scale: length of the tooth [chords] where the radius of curvature is the chord.
    static scale = 0.02;

    // Returns points of a curve, {x, y, tooth_x, tooth_y, curvature}, from x,y pairs along the curve. The curvature is
    // the one of the circle through three neighbours.
    static teeth(line, chord) {
        const teeth = [];
        for (let i = 2; i + 3 < line.length; i += 2) {
            const [ux, uy] = [line[i] - line[i - 2], line[i + 1] - line[i - 1]],
                [vx, vy] = [line[i + 2] - line[i], line[i + 3] - line[i + 1]],
                [wx, wy] = [ux + vx, uy + vy],
                across = Math.hypot(wx, wy),
                lengths = Math.hypot(ux, uy) * Math.hypot(vx, vy) * across;
            if (!(lengths > 0)) continue;
            const curvature = (2 * (ux * vy - uy * vx)) / lengths,
                length = Comb.scale * chord * Math.sign(curvature) * Math.sqrt(Math.abs(curvature) * chord);
            teeth.push({
                x: line[i],
                y: line[i + 1],
                tooth_x: line[i] + (length * wy) / across,
                tooth_y: line[i + 1] - (length * wx) / across,
                curvature,
            });
        }
        return teeth;
    }

    static draw(overlay) {
        const { context, app } = overlay;
        for (const curve of app.curves.curves) {
            const teeth = Comb.teeth(app.curves.outline(curve), app.view.extent);
            context.beginPath();
            for (const { x, y, tooth_x, tooth_y } of teeth) {
                context.moveTo(overlay.px(x), overlay.py(y));
                context.lineTo(overlay.px(tooth_x), overlay.py(tooth_y));
            }
            overlay.stroke("--before", 0.75);
            context.beginPath();
            for (const { tooth_x, tooth_y } of teeth) context.lineTo(overlay.px(tooth_x), overlay.py(tooth_y));
            overlay.stroke("--before", 1.5);
        }
    }
}
