"use strict";
// The shape is the state of control points, design variables of sections and rigid bodies, with undo and redo.

class Shape {
    constructor(data, sections, model) {
        Object.assign(this, { data, sections, model });
        this.state = {
            points: new Array(2 * data.n_control).fill(0), // dx, dy of each, apart from the variables
            variables: sections.map(() => Object.fromEntries(Section.variables.map((variable) => [variable.name, 0]))),
            bodies: data.bodies.map(() => ({ x: 0, y: 0, degrees: 0, scale: 1 })),
        };
        this.undone = [];
        this.done = [];
        this.last = JSON.stringify(this.state);
    }

    // Finishes a change, which undo takes back.
    commit() {
        const now = JSON.stringify(this.state);
        if (now === this.last) return false;
        this.done.push(this.last);
        this.undone = [];
        this.last = now;
        return true;
    }
    // A change that is not finished yet is finished first, or redo could not bring it again.
    undo() {
        this.commit();
        this.exchange(this.done, this.undone);
    }
    redo() {
        this.commit();
        this.exchange(this.undone, this.done);
    }
    exchange(from, to) {
        if (from.length === 0) return;
        to.push(this.last);
        this.last = from.pop();
        this.state = JSON.parse(this.last);
    }

    // Remembers the present state, to which back_to_valid() returns.
    remember_valid() {
        this.last_valid = JSON.stringify(this.state);
    }
    back_to_valid() {
        this.take(JSON.parse(this.last_valid));
    }

    // Takes an unfinished change back.
    restart() {
        this.state = JSON.parse(this.last);
    }
    // Returns the movements of the last finished state.
    finished_moves() {
        return this.moves(JSON.parse(this.last));
    }

    // Changes to another state.
    take(state) {
        this.commit();
        this.state = state;
        this.commit();
    }
    // Returns true if a value has the form of a state: the same names and as many numbers.
    is_state(value) {
        const form = (part) =>
            typeof part === "number" && Number.isFinite(part)
                ? 0
                : Array.isArray(part)
                  ? part.map(form)
                  : part !== null && typeof part === "object"
                    ? Object.keys(part).sort().map((name) => [name, form(part[name])])
                    : null;
        return JSON.stringify(form(value)) === JSON.stringify(form(this.state));
    }

    reset() {
        this.state.points.fill(0);
        for (const variables of this.state.variables) for (const name of Object.keys(variables)) variables[name] = 0;
        for (const body of this.state.bodies) Object.assign(body, { x: 0, y: 0, degrees: 0, scale: 1 });
        this.commit();
    }

    // Gives the control points of a section the movements of a fit, [2*n_control].
    become(section, moves) {
        const values = this.state.variables[this.sections.indexOf(section)];
        for (const name of Object.keys(values)) values[name] = 0;
        for (const i of section.control) this.state.points.splice(2 * i, 2, moves[2 * i], moves[2 * i + 1]);
        this.commit();
    }

    // Returns the array that hm_morph takes: dx,dy of control points, then each body's translation and s - 1.
    moves(state = this.state) {
        const { data } = this,
            moves = new Float64Array(2 * data.n_functions);
        moves.set(state.points);
        this.sections.forEach((section, place) => {
            const values = state.variables[place];
            if (Object.values(values).every((value) => value === 0)) return;
            section.moves(values).forEach((move, k) => (moves[k] += move));
        });
        state.bodies.forEach((body, place) => {
            const [sine, cosine] = sine_cosine(((body.degrees % 360) * Math.PI) / 180);
            moves.set([body.x, body.y, body.scale * cosine - 1, body.scale * sine], 2 * data.n_control + 4 * place);
        });
        return moves;
    }

    // Sets the movement of one control point, which includes the movement by the variables.
    set_point(index, dx, dy) {
        const moves = this.moves(),
            { points } = this.state;
        points[2 * index] = dx - (moves[2 * index] - points[2 * index]);
        points[2 * index + 1] = dy - (moves[2 * index + 1] - points[2 * index + 1]);
    }

    // Returns the text of moves.txt; numbers have all their digits, so that `harmorph morph` reads the same numbers.
    text() {
        const moves = this.moves(),
            lines = ["# control point, dx, dy"];
        for (let i = 0; i < this.data.n_control; ++i) {
            if (moves[2 * i] !== 0 || moves[2 * i + 1] !== 0)
                lines.push(`${i + 1} ${moves[2 * i]} ${moves[2 * i + 1]}`);
        }
        this.state.bodies.forEach((body, place) => {
            lines.push(`rigid ${this.data.bodies[place].marker} ${body.x} ${body.y} ${body.degrees} ${body.scale}`);
        });
        return lines.join("\n") + "\n";
    }

    // Takes the movements of a moves.txt. If a line is not understood, nothing changes and the Error names the line.
    load(text) {
        const points = new Array(2 * this.data.n_control).fill(0);
        const bodies = this.data.bodies.map(() => ({ x: 0, y: 0, degrees: 0, scale: 1 }));
        const seen = new Set();
        text.split("\n").forEach((line, number) => {
            // The name of a marker may have blanks and "#" in quotes.
            const [, text_of_body] = /^\s*rigid\s+(.*)/.exec(line) || [];
            const rigid = text_of_body !== undefined;
            const named = (body) => rigid && `${text_of_body} `.startsWith(`${body.marker} `);
            const place = this.data.bodies.findIndex(named);
            const rest = place < 0 ? line : `rigid body ${text_of_body.slice(this.data.bodies[place].marker.length)}`;
            const words = rest
                .replace(/#.*/, "")
                .trim()
                .split(/\s+/)
                .filter((word) => word !== "");
            if (words.length === 0) return;
            const fail = (reason) => {
                throw new Error(`line ${number + 1}: ${reason}`);
            };
            if (rigid && place < 0) fail(`there is no rigid body ${words[1]}`);
            const values = words.slice(rigid ? 2 : 1).map(Number);
            if (!values.every(Number.isFinite)) fail("a finite number is expected");
            const name = rigid ? `rigid ${this.data.bodies[place].marker}` : words[0];
            if (seen.has(name)) fail(`${name} is moved a second time`);
            seen.add(name);
            if (rigid) {
                if (values.length < 3 || values.length > 4) fail("rigid MARKER dx dy degrees [scale] is expected");
                bodies[place] = {
                    x: values[0],
                    y: values[1],
                    degrees: values[2],
                    scale: values.length > 3 ? values[3] : 1,
                };
            } else {
                const index = Number(words[0]);
                if (!(Number.isInteger(index) && index >= 1 && index <= this.data.n_control)) {
                    fail(`a control point between 1 and ${this.data.n_control} is expected`);
                }
                if (values.length !== 2) fail("index dx dy is expected");
                points.splice(2 * index - 2, 2, ...values);
            }
        });
        for (const variables of this.state.variables) for (const name of Object.keys(variables)) variables[name] = 0;
        Object.assign(this.state, { points, bodies });
        this.commit();
    }
}
