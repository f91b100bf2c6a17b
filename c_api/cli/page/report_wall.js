"use strict";
// The boundary: faces with the mesh on their left, and the first layer on the walls that move.

class Wall {
    constructor(data, model) {
        this.model = model;
        this.faces = Wall.directed_faces(data); // of all markers: {a, b, marker}
        this.moves = data.markers.map((marker) => ["curve", "rigid", "given"].includes(marker.kind));
        this.points = []; // of walls that move: {point, previous, next, above}
        this.slot = new Int32Array(model.n).fill(-1);
        for (const face of this.faces) {
            if (!this.moves[face.marker]) continue;
            this.at(face.a).next = face.b;
            this.at(face.b).previous = face.a;
        }
        this.find_first_layer(data);
        this.chains = this.find_chains(); // {points, closed, marker}
        this.layer = this.points.filter((point) => point.above >= 0);
        this.angle = new Float32Array(this.layer.length); // [degrees] by which the edge turned more than the wall
        this.height = new Float32Array(this.layer.length); // [-] height after over before
    }

    static directed_faces(data) {
        const markers = new Map(),
            key = (a, b) => a * data.x.length + b,
            faces = [];
        data.face_markers.forEach((marker, face) => {
            const a = data.face_points[2 * face],
                b = data.face_points[2 * face + 1];
            markers.set(key(Math.min(a, b), Math.max(a, b)), marker);
        });
        for_each_side(data, (a, b) => {
            const marker = markers.get(key(Math.min(a, b), Math.max(a, b)));
            if (marker !== undefined) faces.push({ a, b, marker });
        });
        return faces;
    }

    at(point) {
        if (this.slot[point] < 0) {
            this.slot[point] = this.points.length;
            this.points.push({ point, previous: -1, next: -1, above: -1 });
        }
        return this.points[this.slot[point]];
    }

    find_chains() {
        const chains = [],
            seen = new Set();
        const marker_of = new Map(this.faces.map((face) => [face.a, face.marker]));
        const follow = (first) => {
            const points = [];
            let point = first;
            while (point >= 0 && !seen.has(point)) {
                seen.add(point);
                points.push(point);
                point = this.at(point).next;
            }
            const { x0: x, y0: y } = this.model,
                last = points[points.length - 1];
            // The wall of a C-mesh begins and ends at the trailing edge with two points at one place.
            const is_cut = points.length > 2 && x[first] === x[last] && y[first] === y[last];
            chains.push({ points, closed: point === first || is_cut, marker: marker_of.get(first) });
        };
        for (const wall of this.points) if (wall.previous < 0) follow(wall.point);
        for (const wall of this.points) if (!seen.has(wall.point)) follow(wall.point);
        return chains;
    }

    // Returns the tangent of the parabola through a point and its neighbours.
    tangent(wall, x, y) {
        const { point, previous, next } = wall;
        const ahead = [x[next] - x[point], y[next] - y[point]],
            behind = [x[point] - x[previous], y[point] - y[previous]];
        if (previous < 0) return ahead;
        if (next < 0) return behind;
        const a = Math.hypot(ahead[0], ahead[1]),
            b = Math.hypot(behind[0], behind[1]);
        return [(a / b) * behind[0] + (b / a) * ahead[0], (a / b) * behind[1] + (b / a) * ahead[1]];
    }

    // Finds the mesh edge from each wall point that is nearest to the normal.
    find_first_layer(data) {
        const { x0: x, y0: y } = this.model;
        const slope = (wall, to) => {
            const [tx, ty] = this.tangent(wall, x, y),
                ux = x[to] - x[wall.point],
                uy = y[to] - y[wall.point];
            return (tx * uy - ty * ux) / Math.hypot(ux, uy) / Math.hypot(tx, ty);
        };
        const offer = (from, to) => {
            if (this.slot[from] < 0 || this.slot[to] >= 0) return;
            const wall = this.points[this.slot[from]];
            if (slope(wall, to) > (wall.above < 0 ? 0 : slope(wall, wall.above))) wall.above = to;
        };
        for_each_side(data, (a, b) => {
            offer(a, b);
            offer(b, a);
        });
    }

    // Returns the angle by which the wall turned at a point: the angles of its faces, weighted as in the tangent.
    turn(wall) {
        const { x0, y0, x, y } = this.model,
            { point, previous, next } = wall;
        const of_face = (a, b) => turn_between(x0[b] - x0[a], y0[b] - y0[a], x[b] - x[a], y[b] - y[a]);
        if (previous < 0) return of_face(point, next);
        if (next < 0) return of_face(previous, point);
        const behind = of_face(previous, point),
            ahead = of_face(point, next);
        const before = Math.hypot(x0[point] - x0[previous], y0[point] - y0[previous]);
        const after = Math.hypot(x0[next] - x0[point], y0[next] - y0[point]);
        return Math.atan2(
            after * Math.sin(behind) + before * Math.sin(ahead),
            after * Math.cos(behind) + before * Math.cos(ahead),
        );
    }

    judge() {
        const { x0, y0, x, y } = this.model;
        this.layer.forEach((wall, i) => {
            const a = wall.point,
                b = wall.above,
                turn = this.turn(wall),
                c = Math.cos(turn),
                s = Math.sin(turn);
            const wx = x0[b] - x0[a],
                wy = y0[b] - y0[a],
                nx = x[b] - x[a],
                ny = y[b] - y[a];
            const ix = c * nx + s * ny,
                iy = c * ny - s * nx; // the moved edge, turned back with the wall
            const [tx, ty] = this.tangent(wall, x0, y0);
            this.angle[i] = (Math.abs(turn_between(wx, wy, ix, iy)) * 180) / Math.PI;
            this.height[i] = (tx * iy - ty * ix) / (tx * wy - ty * wx);
        });
    }
}

function turn_between(ux, uy, vx, vy) {
    return Math.atan2(ux * vy - uy * vx, ux * vx + uy * vy);
}
