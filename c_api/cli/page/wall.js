"use strict";
// The walls that move, with their first layer, and where the boundary touches or crosses itself.

class Wall {
    constructor(data, model) {
        this.model = model;
        this.moves = data.markers.map(() => false); // does the marker move?
        for (const { marker, kind } of data.conditions)
            if (["curve", "rigid", "given"].includes(kind)) this.moves[marker] = true;
        this.faces = Array.from(data.face_markers, (marker, face) => ({
            a: data.face_points[2 * face],
            b: data.face_points[2 * face + 1],
            marker,
        }));
        const moving = [...new Set(data.face_markers.filter((marker) => this.moves[marker]))];
        this.points = []; // {point, next, above}; the mesh is on the left
        if (moving.length > 0) this.find_walls(moving);
        this.chains = this.find_chains(); // {points, closed, marker}
        this.layer = this.points.filter((point) => point.above >= 0);
        this.angle = new Float64Array(this.layer.length); // [degrees] by which the edge turned more than the wall
        this.height = new Float64Array(this.layer.length); // [-] height after over before
    }

    find_walls(markers) {
        const { mesh } = this.model,
            { library } = mesh,
            { layout, memory } = library;
        this.scope = mesh.own();
        this.address = mesh.analysed((analysis, scope) => {
            const list = scope.integers(Int32Array.from(markers), undefined, "markers");
            return this.scope.object("hm_walls_init", analysis, markers.length, list, 0);
        });
        library.with((scope) => {
            const info = scope.struct("hm_walls_info");
            library.call("hm_walls_info_get", this.address, info);
            const member = (name) => layout.get("hm_walls_info", info, name),
                n = member("n_wall_points"),
                n_faces = member("n_faces"),
                ends = memory.integers(member("face_points"), 2 * n_faces),
                above = memory.integers(member("layer_points"), n),
                next = new Map(Array.from({ length: n_faces }, (_, face) => [ends[2 * face], ends[2 * face + 1]]));
            memory.integers(member("wall_points"), n).forEach((point, k) =>
                this.points.push({ point, next: next.get(point) ?? -1, above: above[k] }));
            this.angles = this.scope.take(8 * n);
            this.heights = this.scope.take(8 * n);
        });
    }

    find_chains() {
        const chains = [],
            seen = new Set(),
            at = new Map(this.points.map((wall) => [wall.point, wall])),
            marker_of = new Map();
        for (const { a, b, marker } of this.faces)
            if (this.moves[marker]) for (const point of [a, b]) marker_of.set(point, marker);
        const follow = (first) => {
            const points = [];
            let point = first;
            while (point >= 0 && !seen.has(point)) {
                seen.add(point);
                points.push(point);
                point = at.get(point).next;
            }
            chains.push({ points, closed: point === first, marker: marker_of.get(first) });
        };
        const reached = new Set(this.points.map((wall) => wall.next));
        for (const wall of this.points) if (!reached.has(wall.point)) follow(wall.point);
        for (const wall of this.points) if (!seen.has(wall.point)) follow(wall.point);
        return chains;
    }

    // Takes the reports of hm_assess. touch has the step at which the boundary touches itself first, the point that
    // touches a face, and the face; crossing has two faces that cross each other, or nothing.
    judge({ step, quality }) {
        const [point, a, b] = step.boundaryPoints,
            [c, d, e, f] = quality.crossingPoints;
        this.touch = { step: step.boundary, point, face: { a, b } };
        this.crossing = quality.selfCrossing === 1 ? [[{ a: c, b: d }, { a: e, b: f }]] : [];
        if (this.points.length === 0) return;
        const { model, angles, heights } = this,
            { library } = model.mesh,
            n = this.points.length;
        model.call("hm_first_layer", this.address, model.start, model.at, 0, heights, angles);
        const [angle, height] = [angles, heights].map((address) => library.memory.numbers(address, n));
        let i = 0;
        this.points.forEach((wall, k) => {
            if (wall.above < 0) return;
            this.angle[i] = angle[k];
            this.height[i++] = height[k];
        });
    }
}
