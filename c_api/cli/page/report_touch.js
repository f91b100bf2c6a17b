"use strict";
// The fraction of the movement at which the boundary first touches itself, as hm_step_report.boundary, with the
// formulas of src/morph/touch.cpp.

class FirstTouch {
    // faces are {a, b}.
    constructor(faces, model) {
        this.model = model;
        this.root = this.node(faces.slice());
        this.step = Infinity; // as a fraction of the movement
        this.point = -1; // the point that touches a face
        this.face = null; // this face
    }

    // Makes a node of a tree; faces that lie close together share a node, and eight faces or fewer are not divided.
    node(faces) {
        const node = { faces, parts: null, box: new Float64Array(8) };
        if (faces.length <= 8) return node;
        const { x0: x, y0: y } = this.model,
            box = box_of_points(x, y, faces.map((face) => face.a)),
            at = box[2] - box[0] > box[3] - box[1] ? x : y;
        faces.sort((one, other) => at[one.a] + at[one.b] - at[other.a] - at[other.b]);
        const middle = faces.length >> 1;
        return Object.assign(node, { parts: [this.node(faces.slice(0, middle)), this.node(faces.slice(middle))] });
    }

    // Touches after the limit do not matter; crosses says that the boundary crosses itself after the movement.
    judge(limit, crosses) {
        Object.assign(this, { step: limit, point: -1, face: null });
        if (limit > 0) {
            this.place(this.root);
            this.within(this.root);
        }
        if (this.point < 0) this.step = Infinity;
        // The faces touched each other before the movement already, or rounding hides the touch.
        if (crosses && limit > 1 && this.step > 1) this.step = this.step < 1 + 1e-9 ? 1 : 0;
    }

    // Sets the boxes of the coordinates before the movement and of the displacements: x, y, dx, dy; least, then
    // largest.
    place(node) {
        const { box, parts } = node,
            { x0, y0, dx, dy } = this.model,
            include = (part, low, high) => {
                box[part] = Math.min(box[part], low);
                box[part + 4] = Math.max(box[part + 4], high);
            };
        box.fill(Infinity, 0, 4).fill(-Infinity, 4);
        if (parts !== null) {
            for (const inner of parts) {
                this.place(inner);
                for (let part = 0; part < 4; ++part) include(part, inner.box[part], inner.box[part + 4]);
            }
            return;
        }
        for (const { a, b } of node.faces) {
            [x0, y0, dx, dy].forEach((values, part) =>
                include(part, Math.min(values[a], values[b]), Math.max(values[a], values[b])));
        }
    }

    // Returns true if two boxes may have a point in common before the limit, also in spite of rounding.
    may_meet(one, other) {
        let begin = 0,
            end = this.step;
        for (let axis = 0; axis < 2; ++axis) {
            for (let turn = 0; turn < 2; ++turn) {
                const [a, b] = turn === 0 ? [one, other] : [other, one],
                    value = a[axis] - b[axis + 4],
                    change = a[axis + 2] - b[axis + 6];
                if (value > 0 && change >= 0) return false;
                if (change > 0) end = Math.min(end, -value / change);
                if (change < 0) begin = Math.max(begin, -value / change);
            }
        }
        return begin * (1 - 1e-9) <= end;
    }

    within(node) {
        if (node.parts !== null) {
            this.within(node.parts[0]);
            this.within(node.parts[1]);
            this.between(node.parts[0], node.parts[1]);
            return;
        }
        node.faces.forEach((face, place) => {
            for (const other of node.faces.slice(place + 1)) this.pair(face, other);
        });
    }

    between(one, other) {
        if (!this.may_meet(one.box, other.box)) return;
        if (one.parts === null && other.parts === null) {
            for (const face of one.faces) for (const another of other.faces) this.pair(face, another);
        } else if (other.parts === null || (one.parts !== null && one.faces.length > other.faces.length)) {
            for (const part of one.parts) this.between(part, other);
        } else {
            for (const part of other.parts) this.between(one, part);
        }
    }

    pair(one, other) {
        if (one.across === other.marker) return;
        for (const point of [one.a, one.b]) this.point_against(point, other);
        for (const point of [other.a, other.b]) this.point_against(point, one);
    }

    point_against(p, face) {
        const { a, b } = face,
            { x0, y0, dx, dy } = this.model;
        if (p === a || p === b) return;
        const ux = x0[b] - x0[a],
            uy = y0[b] - y0[a],
            vx = dx[b] - dx[a],
            vy = dy[b] - dy[a],
            px = x0[p] - x0[a],
            py = y0[p] - y0[a],
            qx = dx[p] - dx[a],
            qy = dy[p] - dy[a];
        const area = ux * py - uy * px,
            slope = ux * qy - uy * qx + vx * py - vy * px,
            curvature = vx * qy - vy * qx;
        const touches = (s) => {
            const sx = ux + s * vx,
                sy = uy + s * vy,
                square = sx * sx + sy * sy,
                part = sx * (px + s * qx) + sy * (py + s * qy);
            return square > 0 && part >= -1e-12 * square && part <= (1 + 1e-12) * square;
        };
        const offer = (s) => {
            if (s > 0 && s < this.step && touches(s)) Object.assign(this, { step: s, point: p, face });
        };
        const meeting = (x, y, mx, my) => (Math.abs(mx) > Math.abs(my) ? -x / mx : -y / my);
        if (area !== 0) {
            const sign = Math.sign(area),
                first = smallest_positive_root(sign * curvature, sign * slope, sign * area);
            offer(first);
            offer(area / first / curvature); // the product of both roots is area / curvature
        } else if (slope !== 0 || curvature !== 0) {
            const s = -slope / curvature;
            if (Math.abs(curvature) * s * s > 4e-12 * (ux * ux + uy * uy)) offer(s);
        } else if (!touches(0)) {
            offer(meeting(px, py, qx, qy));
            offer(meeting(px - ux, py - uy, qx - vx, qy - vy));
        }
    }
}
