"use strict";
// States that the user keeps under names. Save writes them as comments of moves.txt, which other programs skip.

class States {
    constructor(app) {
        this.app = app;
        this.kept = new Map(); // states as JSON, by name
        element("keep_state").onclick = () => this.keep(element("state_name").value.trim());
        element("state_name").onkeydown = (event) => {
            if (event.key === "Enter") element("keep_state").click();
        };
    }

    // Keeps the present state; without a name, the state has the next free number.
    keep(name) {
        this.app.commit();
        for (let number = this.kept.size + 1; name === ""; ++number)
            if (!this.kept.has(`State ${number}`)) name = `State ${number}`;
        this.kept.set(name, JSON.stringify(this.app.shape.state));
        element("state_name").value = "";
        this.show();
        this.app.panel.speak(`${name} is kept`);
    }

    show() {
        element("states").replaceChildren(
            ...[...this.kept].map(([name, state]) => {
                const row = document.createElement("li"),
                    [choose, remove] = [0, 1].map(() => document.createElement("button"));
                choose.textContent = name;
                choose.title = `Back to ${name}`;
                choose.onclick = () => this.app.after(() => this.app.shape.take(JSON.parse(state)));
                remove.textContent = "×";
                remove.setAttribute("aria-label", (remove.title = `Delete ${name}`));
                remove.onclick = () => {
                    this.kept.delete(name);
                    this.show();
                };
                row.append(choose, remove);
                return row;
            }),
        );
    }

    // Returns one line for each state.
    text() {
        return [...this.kept].map(([name, state]) => `# state ${JSON.stringify(name)}: ${state}\n`).join("");
    }

    // Returns the states in a text, or throws an Error that names the line of a state that is not one of this page.
    read(text) {
        const found = new Map();
        text.split("\n").forEach((line, number) => {
            if (!/^# state "/.test(line)) return;
            try {
                const [, name, state] = line.match(/^# state ("(?:[^"\\]|\\.)*"): (.*)$/);
                if (!this.app.shape.is_state(JSON.parse(state))) throw new Error();
                found.set(JSON.parse(name), state);
            } catch (error) {
                throw new Error(`line ${number + 1}: the kept state belongs to other control points or bodies`);
            }
        });
        return found;
    }
    add(states) {
        for (const [name, state] of states) this.kept.set(name, state);
        this.show();
    }
}
