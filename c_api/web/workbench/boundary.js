"use strict";
// The pieces of the boundary, what each of them does when the shape moves, and the options that say so.

const ROLES = [["fixed", "fixed"], ["curve", "follows a curve"], ["rigid", "rigid body"], ["slip", "slips"]];
// The colours of the picture that `harmorph check --svg` draws.
const COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];
const WALL = /wall|foil|wing|body|naca|rae|blade|profile|section|main|slat|flap|bump|cylinder|element/i;
const OUTER = /far|inlet|outlet|inflow|outflow|symm|period|top|bottom|left|right|outer|free|empty|inter|wake/i;

class Boundary {
    // facts: of `harmorph check --json`. changed() is called when a role changes.
    constructor(facts, changed) {
        const count = new Map();
        for (const { name } of facts.pieces) count.set(name, (count.get(name) ?? 0) + 1);
        this.markers = facts.markers.map(({ name }) => name);
        this.pieces = facts.pieces.map((piece) => ({
            ...piece,
            place: quoted(piece.name) + (count.get(piece.name) > 1 ? `@${piece.x}:${piece.y}` : ""),
            role: "fixed",
        }));
        this.changed = changed;
        this.guess();
    }

    // The wall: bodies inside the mesh whose name is not that of another boundary; otherwise, pieces that have the name
    // of a wall.
    guess() {
        const bodies = this.pieces.filter(({ body, name }) => body && !OUTER.test(name)),
            named = this.pieces.filter(({ name }) => WALL.test(name) && !OUTER.test(name)),
            walls = bodies.length > 0 ? bodies : named;
        // More pieces than a person would choose by hand are no guess.
        const loops = new Set(walls.map(({ loop }) => loop));
        this.guessed = loops.size <= 8 ? new Set(walls) : new Set();
        for (const piece of this.guessed) piece.role = "curve";
    }

    show(list) {
        const most = 200, // elements
            rows = this.pieces.slice(0, most).map((piece, place) => this.row(piece, place));
        if (this.pieces.length > most) {
            const rest = document.createElement("li");
            rest.textContent = `and ${this.pieces.length - most} more, which are fixed`;
            rows.push(rest);
        }
        list.replaceChildren(...rows);
    }
    row(piece, place) {
        const row = document.createElement("li"),
            colour = document.createElement("i"),
            name = document.createElement("span"),
            role = document.createElement("select"),
            says = document.createElement("small");
        colour.style.background = COLOURS[this.markers.indexOf(piece.name) % COLOURS.length];
        name.className = "name";
        name.textContent = piece.name === "" ? "(no name)" : piece.name;
        name.title = piece.name;
        const brief = (number) => Number(number.toPrecision(3)),
            faces = piece.faces === 1 ? "1 face" : `${piece.faces} faces`;
        const shape = piece.closed ? "closed, " : "";
        says.textContent = `${faces}, ${shape}x ${brief(piece.low_x)} to ${brief(piece.high_x)}`;
        role.setAttribute("aria-label", `What ${name.textContent} does`);
        for (const [value, text] of ROLES) {
            const option = new Option(text, value);
            option.selected = value === piece.role;
            role.append(option);
        }
        role.id = `role_${place}`;
        role.onchange = () => {
            piece.role = role.value;
            row.classList.toggle("moves", piece.role !== "fixed");
            this.changed();
        };
        row.classList.toggle("moves", piece.role !== "fixed");
        if (this.guessed.has(piece)) {
            const mark = document.createElement("em");
            mark.textContent = "guess";
            name.append(" ", mark);
        }
        row.append(colour, name, role, says);
        return row;
    }

    // Returns the pieces with a role, as lists of those on one loop of the boundary.
    groups(role) {
        const groups = new Map();
        for (const piece of this.pieces) {
            if (piece.role !== role) continue;
            groups.set(piece.loop, [...(groups.get(piece.loop) ?? []), piece]);
        }
        return [...groups.values()];
    }
    static places(group) {
        return [...new Set(group.map(({ place }) => place))].join(",");
    }

    // Returns the options of solve and displace; curves: paths of the curves of the groups.
    conditions(curves) {
        const words = [];
        this.groups("curve").forEach((group, k) => words.push("--curve", `${Boundary.places(group)}=${curves[k]}`));
        return [...words, ...this.beside()];
    }
    // Returns the options for walls that follow no curve.
    beside() {
        const words = [];
        for (const group of this.groups("rigid")) words.push("--rigid", Boundary.places(group));
        for (const group of this.groups("slip")) words.push("--slip", Boundary.places(group));
        return words;
    }
    // Returns what lines that turn, shift, scale or deflect a section can name.
    sections() {
        return this.groups("curve").map(Boundary.places);
    }
    moves() {
        return this.groups("curve").length + this.groups("rigid").length > 0;
    }
}
