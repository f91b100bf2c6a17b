"use strict";
// The part of the panel for designers: locks, curvature comb, kept states, and the pressure of potential flow.

class Design {
    constructor(app, controls) {
        this.app = app;
        this.states = new States(app);
        this.before = null; // the pressure before anything moves
        element("locks_and_views").hidden = element("attack_box").hidden = app.sections.length === 0;
        for (const name of ["area", "thickness"]) {
            element(`lock_${name}`).onclick = () => {
                app.commit();
                app.movement.locks.toggle(name);
                this.show_pressed(`lock_${name}`, app.movement.locks.measures.includes(name));
            };
        }
        for (const name of ["comb", "pressure"]) {
            element(name).onclick = () => {
                app.set({ [name]: !app.options[name] });
                this.show_pressed(name, app.options[name]);
            };
        }
        controls.number_field(element("attack"), (degrees) => {
            this.before = null;
            app.set({ attack: degrees });
        });
    }

    show_pressed(id, pressed) {
        element(id).setAttribute("aria-pressed", pressed);
    }

    // Returns the pressure round all sections whose walls have their points at x, y.
    pressure(x, y) {
        const rings = this.app.sections.map(({ points, trailing }) => new NodeRing(points, trailing, x, y));
        return Object.assign(new Pressure(rings, this.app.options.attack), { rings });
    }

    update() {
        const { app } = this,
            { pressure } = app.options;
        element("pressure_box").hidden = !pressure;
        if (!pressure) return;
        const { model, wall } = app,
            crosses = wall.crossing.length > 0;
        element("lift").textContent = crosses ? "The wall crosses itself; there is no flow round it." : "";
        element("pressure_chart").hidden = crosses;
        if (crosses) return;
        this.before = this.before || this.pressure(model.x0, model.y0);
        const now = app.still ? this.before : this.pressure(model.x, model.y),
            lift = (flow) => flow.lift.map((value) => fixed(value, 3)).join(", ");
        element("lift").textContent =
            `Lift coefficient ${lift(now)}${app.still ? "" : `, before ${lift(this.before)}`}. ` +
            "Incompressible potential flow.";
        this.draw_pressure(now);
    }

    // Draws the pressure along the x axis: before in blue, now in red.
    draw_pressure(now) {
        const flows = this.app.still ? [now] : [this.before, now],
            points = (flow) => {
                const nodes = flow.rings.flatMap((ring) => ring.nodes);
                return nodes.map((node, i) => [node.x, -flow.cp[i]]);
            },
            all = flows.flatMap(points),
            values = (part) => all.map((point) => point[part]),
            range = (part) => [Math.min(...values(part)), Math.max(...values(part))],
            box = element("pressure_chart");
        const chart = new Chart({ x: range(0), y: range(1), x_name: "x", width: box.clientWidth || 340, height: 200 });
        flows.forEach((flow) => {
            const line = points(flow);
            flow.rings.forEach((ring, k) => {
                const begin = flow.starts[k],
                    colour = flow === now ? "var(--after)" : "var(--before)";
                chart.curve(line.slice(begin, begin + ring.nodes.length), colour);
            });
        });
        const rows = now.rings.flatMap((ring, k) =>
            ring.nodes.map(({ x, y }, i) => [x, y, now.cp[now.starts[k] + i]]),
        );
        chart.show_in(box, "−cp before (blue) and now (red)", "pressure", ["x", "y", "cp"], rows);
    }
}
