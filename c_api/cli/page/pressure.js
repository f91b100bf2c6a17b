"use strict";
// The pressure of incompressible potential flow round closed sections, by panels on which the strength of vortices is
// linear. The strength at a node is the speed there. The stream function is constant on each section, and the condition
// of Kutta is that the speeds on both sides of the trailing edge are equal. Far from the sections, the speed is 1.

// The nodes of one section, from the trailing edge round the section and back to the trailing edge, counter-clockwise.
class NodeRing {
    // Takes the points of a closed wall in order; first is the place of the trailing edge. At most `most` points are
    // used.
    constructor(points, first, x, y, most = 200) {
        const n = points.length,
            stride = Math.max(1, Math.ceil(n / most));
        let nodes = [];
        for (let i = 0; i < n; i += stride) nodes.push(points[(first + i) % n]);
        nodes.push(points[first]);
        nodes = nodes.map((k) => ({ x: x[k], y: y[k] }));
        nodes = nodes.filter((node, i) => i === 0 || node.x !== nodes[i - 1].x || node.y !== nodes[i - 1].y);
        let twice_area = 0;
        for (let i = 1; i < nodes.length; ++i)
            twice_area += nodes[i - 1].x * nodes[i].y - nodes[i].x * nodes[i - 1].y;
        this.nodes = twice_area < 0 ? nodes.reverse() : nodes;
        this.chord = Math.max(...nodes.map((node) => NodeRing.distance(node, nodes[0])));
        this.open_blunt_edge();
        this.is_sharp = NodeRing.distance(this.nodes[0], this.nodes[this.nodes.length - 1]) < 1e-6 * this.chord;
    }

    static distance(one, other) {
        return Math.hypot(one.x - other.x, one.y - other.y);
    }

    // A blunt trailing edge stays open: no vortices lie on the base, whose panels are steep beside those of the side.
    open_blunt_edge() {
        const { nodes, chord } = this,
            edge = nodes[0],
            middle = nodes.length >> 1,
            is_base = (one, other, side) => {
                const [ux, uy] = [other.x - one.x, other.y - one.y],
                    [vx, vy] = [nodes[side].x - edge.x, nodes[side].y - edge.y],
                    lengths = Math.hypot(ux, uy) * Math.hypot(vx, vy);
                return NodeRing.distance(one, edge) < 0.03 * chord && Math.abs(ux * vx + uy * vy) < 0.7 * lengths;
            };
        let [begin, end] = [0, nodes.length - 1];
        while (begin < middle && is_base(nodes[begin], nodes[begin + 1], middle)) ++begin;
        while (end > middle && is_base(nodes[end], nodes[end - 1], middle)) --end;
        this.nodes = nodes.slice(begin, end + 1);
    }
}

class Pressure {
    // Solves for rings of nodes; degrees is the angle between the free stream and the x axis.
    constructor(rings, degrees) {
        const angle = (degrees * Math.PI) / 180,
            n = rings.reduce((sum, ring) => sum + ring.nodes.length, 0),
            size = n + rings.length,
            rows = [];
        let first = 0;
        this.starts = rings.map((ring) => (first += ring.nodes.length) - ring.nodes.length);
        rings.forEach((ring, place) => {
            const last = ring.nodes.length - 1,
                begin = this.starts[place];
            ring.nodes.forEach((node, i) => {
                const row = new Float64Array(size + 1);
                if (ring.is_sharp && i === last) {
                    // This node has the equation of the first one already: the mean of both sides is linear instead.
                    [1, -2, 1].forEach((factor, k) => {
                        row[begin + k] += factor;
                        row[begin + last - k] -= factor;
                    });
                } else {
                    rings.forEach((other, at) => Pressure.add_stream(row, node, other.nodes, this.starts[at]));
                    row[n + place] = -1;
                    row[size] = Math.sin(angle) * node.x - Math.cos(angle) * node.y;
                }
                rows.push(row);
            });
        });
        rings.forEach((ring, place) => {
            const row = new Float64Array(size + 1);
            row[this.starts[place]] = row[this.starts[place] + ring.nodes.length - 1] = 1;
            rows.push(row);
        });
        this.speed = solve_linear(rows).subarray(0, n);
        this.cp = this.speed.map((speed) => 1 - speed * speed);
        // The lift coefficient of each section with its own chord, by the theorem of Kutta and Joukowski.
        this.lift = rings.map((ring, place) => {
            let circulation = 0;
            for (let i = 1; i < ring.nodes.length; ++i) {
                const k = this.starts[place] + i,
                    length = NodeRing.distance(ring.nodes[i - 1], ring.nodes[i]);
                circulation += 0.5 * length * (this.speed[k - 1] + this.speed[k]);
            }
            return (2 * circulation) / ring.chord;
        });
    }

    // Adds to a row the stream function at a node by clockwise vortices on the panels between nodes, whose strength is
    // 1 at one node, and 0 at the others.
    static add_stream(row, { x, y }, nodes, start) {
        for (let j = 1; j < nodes.length; ++j) {
            const [one, other] = [nodes[j - 1], nodes[j]],
                length = NodeRing.distance(one, other),
                [tx, ty] = [(other.x - one.x) / length, (other.y - one.y) / length],
                along = (x - one.x) * tx + (y - one.y) * ty,
                beyond = along - length,
                height = (y - one.y) * tx - (x - one.x) * ty,
                near = along * along + height * height,
                far = beyond * beyond + height * height,
                near_log = near > 0 ? Math.log(near) : 0,
                far_log = far > 0 ? Math.log(far) : 0,
                turn = near > 0 && far > 0 ? Math.atan2(height * length, along * beyond + height * height) : 0,
                sum = 0.5 * along * near_log - 0.5 * beyond * far_log - length + height * turn,
                squares = far * far_log - near * near_log + along * along - beyond * beyond,
                difference = ((along + beyond) * sum + 0.5 * squares) / length;
            row[start + j - 1] += (sum - difference) / (4 * Math.PI);
            row[start + j] += (sum + difference) / (4 * Math.PI);
        }
    }
}

// Returns the solution of a system whose rows end with the right-hand side; overwrites the rows.
function solve_linear(rows) {
    const n = rows.length,
        solution = new Float64Array(n);
    for (let k = 0; k < n; ++k) {
        let pivot = k;
        for (let i = k + 1; i < n; ++i) if (Math.abs(rows[i][k]) > Math.abs(rows[pivot][k])) pivot = i;
        [rows[k], rows[pivot]] = [rows[pivot], rows[k]];
        const top = rows[k];
        for (let i = k + 1; i < n; ++i) {
            const row = rows[i],
                factor = row[k] / top[k];
            for (let j = k; j <= n && factor !== 0; ++j) row[j] -= factor * top[j];
        }
    }
    for (let k = n - 1; k >= 0; --k) {
        let sum = rows[k][n];
        for (let j = k + 1; j < n; ++j) sum -= rows[k][j] * solution[j];
        solution[k] = sum / rows[k][k];
    }
    return solution;
}
