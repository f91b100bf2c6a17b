// Meshes: arrays in the memory of the module, with markers that have names.
import { disposable, Owner } from "./library.js";
import { refuse, show, whole } from "./errors.js";

/** A mesh in two dimensions; index.d.ts describes the arguments. */
export class Mesh extends Owner {
    constructor(points, cells, boundary) {
        super();
        const scope = this.own();
        try {
            this.make(scope, points, cells, boundary);
        } catch (error) {
            this.disown(scope);
            throw error;
        }
        this.scope = scope;
    }

    make(scope, points, cells, boundary) {
        const { length } = points?.view ?? points ?? [];
        if (length === undefined || length % 2 !== 0) {
            refuse(`points must be pairs x, y, x, y, ... of numbers, not ${show(points)}.`);
        }
        this.nPoints = whole(length / 2, "the number of points", 0, 2 ** 30);
        const copy = scope.take(8 * length);
        this.library.with((passing) => {
            const from = passing.numbers(points, length, "points");
            this.library.memory.u8.copyWithin(copy, from, from + 8 * length);
        });
        this.point_address = copy;
        this.markers = numbered(boundary);
        // The description is one object, so that a Morph can copy the mesh.
        this.description = { ...cells_of(cells, this.nPoints), ...boundary_of(boundary, this.markers) };
        this.names = Object.fromEntries([...this.markers].map(([name, number]) => [number, name]));
        this.nCells = this.description.cell_count;
        this.address = this.describe(scope, copy);
    }

    /** Writes the mesh with coordinates at `points` into a scope; returns the address of hm_mesh. */
    describe(scope, points) {
        const { constants } = this.library;
        const { layout, counts, arrays } = this.description;
        const members = { n_points: this.nPoints, points: { x: points, y: points + 8, stride: 2 }, ...counts };
        members.cell_layout = constants[layout];
        for (const [name, array] of Object.entries({ ...arrays, ...this.description.lists })) {
            members[name] = array.length === 0 ? 0 : scope.copied(array);
        }
        members.n_faces = this.description.lists.face_markers.length;
        members.n_lists = this.description.lists.list_markers.length;
        return scope.struct("hm_mesh", members);
    }

    /** The coordinates x, y, x, y, ...: a view of the memory, which ends when the memory grows. */
    get points() {
        this.open();
        return this.library.memory.numbers(this.point_address, 2 * this.nPoints);
    }

    open() {
        if (this.scope === null) refuse("This mesh was freed.");
        return this;
    }

    /** Returns the number of a marker; refuses one that the mesh does not have. */
    marker(name) {
        const found = this.markers.get(name);
        if (found !== undefined) return found;
        const known = [...this.markers.keys()].map(show).join(", ");
        return refuse(`The mesh has no marker ${show(name)}; its markers are ${known}.`, "HM_BAD_CONDITION",
            { kind: "marker" });
    }

    /** Returns the numbers of one marker or of several. */
    numbers_of(markers) {
        return (Array.isArray(markers) ? markers : [markers]).map((name) => this.marker(name));
    }

    // Calls body(analysis, scope) with an analysis of the mesh alone.
    analysed(body) {
        this.open();
        return this.library.with((scope) => {
            const problem = scope.struct("hm_problem", { mesh: this.address });
            return body(scope.object("hm_analysis_init", problem, 0), scope);
        });
    }

    /** Checks the mesh and counts what is in it: the members of hm_mesh_report. */
    report() {
        return this.analysed((analysis, scope) => {
            const report = scope.struct("hm_mesh_report");
            this.library.call("hm_analysis_report", analysis, report);
            return this.library.layout.read("hm_mesh_report", report);
        });
    }

    /** Returns the points of markers in order along the boundary, the mesh on the left. */
    wall(markers, piece = 0) {
        whole(piece, "piece");
        const numbers = this.numbers_of(markers);
        return this.analysed((analysis, scope) => {
            const { memory } = this.library;
            const list = scope.integers(numbers, undefined, "markers");
            const points = scope.take(4 * this.nPoints);
            const n = scope.take(8);
            this.library.call("hm_analysis_boundary", analysis, numbers.length, list, piece, points,
                this.nPoints, n, n + 4);
            const count = memory.data.getInt32(n, true);
            return { points: memory.integers(points, count).slice(), isLoop: memory.data.getInt32(n + 4, true) === 1 };
        });
    }

    /** Gives the memory of the mesh back; objects that were made from the mesh stay usable. */
    free() {
        this.scope = this.disown(this.scope);
    }
}
disposable(Mesh);

// Each name receives the smallest number that is free, in the order of the names; integers are
// their own numbers.
function numbered(boundary) {
    if (typeof boundary !== "object" || boundary === null) {
        refuse("boundary must be an object or a Map: points by marker.");
    }
    const entries = boundary instanceof Map ? [...boundary.keys()] : Object.keys(boundary);
    const markers = new Map();
    for (const name of entries) {
        if (typeof name === "number") markers.set(name, whole(name, "a marker"));
        else if (typeof name !== "string") refuse(`A marker is a name or a whole number, not ${show(name)}.`);
    }
    const taken = new Set(markers.values());
    let free = 0;
    for (const name of entries.filter((one) => typeof one === "string").sort()) {
        while (taken.has(free)) ++free;
        markers.set(name, free++);
    }
    return markers;
}

// A run of points, or { edges }: two points for each edge.
function boundary_of(boundary, markers) {
    const faces = [], face_markers = [], lists = [0], list_points = [], list_markers = [];
    for (const [name, number] of markers) {
        const given = boundary instanceof Map ? boundary.get(name) : boundary[name];
        const edges = given?.edges;
        const points = edges ?? given;
        if (typeof points !== "object" || points === null || points.length === undefined) {
            refuse(`Marker ${show(name)} must have an array of points, or { edges: array }, not ${show(given)}.`);
        }
        const list = whole_numbers(points, `marker ${show(name)}`);
        if (edges !== undefined) {
            if (list.length % 2 !== 0) refuse(`The edges of marker ${show(name)} must be pairs of points.`);
            for (const point of list) faces.push(point);
            for (let k = 0; k < list.length / 2; ++k) face_markers.push(number);
        } else {
            for (const point of list) list_points.push(point);
            lists.push(list_points.length);
            list_markers.push(number);
        }
    }
    return {
        lists: {
            face_points: Int32Array.from(faces),
            face_markers: Int32Array.from(face_markers),
            list_start: list_markers.length === 0 ? new Int32Array(0) : Int32Array.from(lists),
            list_points: Int32Array.from(list_points),
            list_markers: Int32Array.from(list_markers),
        },
    };
}

function cells_of(cells, n_points) {
    if (typeof cells !== "object" || cells === null) refuse(`cells must be an object, not ${show(cells)}.`);
    const { triangles, quads, start, points, ni, nj, blocks } = cells;
    if (blocks !== undefined) return blocks_of(blocks);
    if (ni !== undefined || nj !== undefined) {
        const counts = { ni: whole(ni, "ni", 2), nj: whole(nj, "nj", 2) };
        return { layout: "HM_CELLS_STRUCTURED", counts, arrays: {}, cell_count: (ni - 1) * (nj - 1) };
    }
    if (start !== undefined) return rows_of(start, points, cells.polygons);
    const three = rows(triangles ?? [], 3, "triangles"), four = rows(quads ?? [], 4, "quads");
    const n_cells = three.length / 3 + four.length / 4;
    if (triangles === undefined && quads === undefined) {
        refuse("cells must have triangles, quads, start and points, ni and nj, or blocks.");
    }
    if (four.length === 0) return listed("HM_CELLS_TRIANGLES", n_cells, { cell_points: three });
    if (three.length === 0) return listed("HM_CELLS_QUADS", n_cells, { cell_points: four });
    const mixed = listed("HM_CELLS_MIXED", n_cells, { cell_points: three, quad_points: four });
    mixed.counts.n_quads = four.length / 4;
    return mixed;
}

function listed(layout, n_cells, arrays) {
    return { layout, counts: { n_cells }, arrays, cell_count: n_cells };
}

function rows(given, size, what) {
    const list = whole_numbers(given, what);
    if (list.length % size !== 0) refuse(`${what} must have ${size} points for each cell.`);
    return list;
}

// Compressed rows. The library reads cell_points as far as cell_start says, so the two are compared.
function rows_of(start, points, polygons) {
    const begin = whole_numbers(start, "start"), list = whole_numbers(points ?? [], "points of cells");
    let most = 0;
    for (let k = 0; k + 1 < begin.length; ++k) most = Math.max(most, begin[k + 1] - begin[k]);
    const is_whole = begin.length > 1 && begin[0] === 0 && begin.at(-1) === list.length;
    if (!is_whole || begin.some((one, k) => k > 0 && one < begin[k - 1])) {
        refuse("start must grow from 0 to the length of points.");
    }
    const layout = polygons || most > 4 ? "HM_CELLS_POLYGONS" : "HM_CELLS_ROWS";
    return listed(layout, begin.length - 1, { cell_start: begin, cell_points: list });
}

function blocks_of(blocks) {
    if (!Array.isArray(blocks)) refuse("blocks must be an array of pairs [ni, nj].");
    const sizes = [];
    let n_cells = 0;
    for (const block of blocks) {
        if (!Array.isArray(block) || block.length !== 2) refuse("blocks must be an array of pairs [ni, nj].");
        sizes.push(whole(block[0], "ni", 2), whole(block[1], "nj", 2));
        n_cells += (block[0] - 1) * (block[1] - 1);
    }
    const found = listed("HM_CELLS_BLOCKS", 0, { block_sizes: Int32Array.from(sizes) });
    return { ...found, counts: { n_blocks: blocks.length }, cell_count: n_cells };
}

function whole_numbers(given, what) {
    if (given instanceof Int32Array) return given.slice();
    if (typeof given !== "object" || given === null || typeof given.length !== "number") {
        refuse(`${what} must be an array of whole numbers, not ${show(given)}.`);
    }
    return Int32Array.from(given, (value, k) => whole(value, `entry ${k} of ${what}`));
}
