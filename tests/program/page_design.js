"use strict";
// Does on the page of `harmorph explore` what a designer does: several control points at once, mirrored drags, locks,
// the curvature comb, kept states, and the pressure. Leaves lines "check NAME ok" or "check NAME FAILED ..." as page.js
// does.
(() => {
    const lines = [];
    const check = (name, holds, found = "") => lines.push(`check ${name} ${holds ? "ok" : `FAILED ${found}`}`);
    const handles = document.getElementById("handles");
    const frame = () => {
        if (app.must_follow) app.follow();
        app.draw();
    };
    const mouse = (type, [x, y], extra = {}) => {
        const box = handles.getBoundingClientRect();
        const at = { clientX: box.left + x, clientY: box.top + y };
        handles.dispatchEvent(
            new PointerEvent(type, { pointerId: 1, pointerType: "mouse", bubbles: true, ...at, ...extra }));
    };
    const key = (name, extra = {}) =>
        handles.dispatchEvent(
            new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true, ...extra }));
    const place_of = (i) => [
        app.camera.pixel_x(app.curves.control[2 * i]),
        app.camera.pixel_y(app.curves.control[2 * i + 1]),
    ];
    const click = (i, extra) => {
        mouse("pointerdown", place_of(i), extra);
        mouse("pointerup", place_of(i), extra);
    };
    // Drags a point by some pixels in three parts, all but the last one with other numbers.
    const drag = (i, dx, dy, extra) => {
        const [x, y] = place_of(i);
        mouse("pointerdown", [x, y]);
        for (const part of [3, -0.5, 1]) mouse("pointermove", [x + part * dx, y + part * dy], extra);
        mouse("pointerup", [x + dx, y + dy], extra);
        frame();
    };
    const back_to_start = () => {
        app.selection.choose(-1);
        element("reset").click();
        frame();
    };
    const chosen = () => [...app.selection.points].sort((a, b) => a - b).join();
    const near = (a, b, allowed) => Math.abs(a - b) <= allowed;

    const several = () => {
        click(2);
        click(5, { shiftKey: true });
        click(7, { shiftKey: true });
        check("Shift and a click add points", chosen() === "2,5,7", chosen());
        click(7, { shiftKey: true });
        check("and remove one again", chosen() === "2,5", chosen());
        drag(2, 12, -30);
        const { moves } = app,
            up = 30 / app.camera.scale;
        check("a drag moves all of them by as much", [2, 5].every((i) => near(moves[2 * i + 1], up, app.movement.digit)) &&
            moves[4] === moves[10], `${moves[5]} ${moves[11]} ${up}`);
        check("and no other point", moves.filter((move) => move !== 0).length === 4);
        key("ArrowRight", { shiftKey: true });
        frame();
        check("an arrow key moves all of them", near(app.moves[4] - moves[4], app.view.extent / 100, app.movement.digit) &&
            app.moves[4] === app.moves[10]);
        const field = element("dy");
        field.value = "0.0125";
        field.dispatchEvent(new Event("input"));
        field.dispatchEvent(new Event("change"));
        frame();
        check("a typed number moves all of them", app.moves[11] === 0.0125 && near(app.moves[5], 0.0125, 1e-12), app.moves[5]);
        for (let i = 0; i < 3; ++i) key("z", { ctrlKey: true });
        frame();
        check("undo takes the movements back", app.still);
        back_to_start();
        const corner = [4, 5].map(place_of),
            low = [0, 1].map((axis) => Math.min(...corner.map((at) => at[axis])) - 20),
            high = [0, 1].map((axis) => Math.max(...corner.map((at) => at[axis])) + 20);
        const inside = [...Array(app.data.n_control).keys()].filter((i) =>
            place_of(i).every((at, axis) => at >= low[axis] && at <= high[axis]));
        // The frame may not begin on a control point.
        const begin = [low, [high[0], low[1]], high, [low[0], high[1]]].find(([x, y]) => app.drag.find(x, y, 16) === null);
        const end = [low[0] + high[0] - begin[0], low[1] + high[1] - begin[1]];
        mouse("pointerdown", begin, { shiftKey: true });
        mouse("pointermove", end, { shiftKey: true });
        frame();
        mouse("pointerup", end, { shiftKey: true });
        check("a frame chooses the points inside", chosen() === inside.join() && inside.length > 1, `${chosen()}; ${inside}`);
        app.selection.choose(3);
        key("n");
        check("N adds the next point", chosen() === "3,4" && app.selection.point === 4, chosen());
        key("a", { ctrlKey: true });
        check("Ctrl A chooses all points", app.selection.points.size === app.data.n_control);
        key("Escape");
        check("Escape chooses none", app.selection.is_empty());
        check("the keys say how to choose several points", /Ctrl A/.test(element("keys").textContent));
    };

    const mirrored = () => {
        const i = [...app.pairs.partner.keys()].find((index) => app.pairs.partner[index] > 0),
            j = app.pairs.partner[i];
        app.selection.choose(i);
        drag(i, 9, -20, { altKey: true });
        const [dx, dy, px, py] = [app.moves[2 * i], app.moves[2 * i + 1], app.moves[2 * j], app.moves[2 * j + 1]];
        check("Alt mirrors a drag", dy !== 0 && near(dy, -py, 2 * app.movement.digit) && near(dx, px, 2 * app.movement.digit),
            `${dx} ${dy} ${px} ${py}`);
        drag(i, 0, -5);
        check("for this drag alone", app.moves[2 * j + 1] === py);
        back_to_start();
    };

    const locks = () => {
        const i = 4,
            [section] = app.sections;
        for (const names of [["area"], ["thickness"], ["area", "thickness"]]) {
            const name = names.join(" and ");
            for (const one of names) element(`lock_${one}`).click();
            const start = { ...section.now };
            app.selection.choose(i);
            drag(i, 0, 12);
            check(`${name}: a dragged point is where the pointer is`,
                near(-app.moves[2 * i + 1], 12 / app.camera.scale, app.movement.digit));
            const first = app.moves.slice();
            key("ArrowUp");
            const range = document.querySelector("#sliders input[type=range]");
            range.value = 5;
            range.dispatchEvent(new Event("input"));
            range.dispatchEvent(new Event("change"));
            frame();
            for (const one of names) {
                check(`${name} stays`, near(section.now[one], start[one], 1e-11 * start[one]),
                    `${one} ${section.now[one]} ${start[one]}`);
            }
            const other = { area: "thickness", thickness: "area" }[names.length === 1 ? names[0] : ""];
            if (other) check(`${other} is free with ${name}`, !near(section.now[other], start[other], 1e-6));
            key("z", { ctrlKey: true });
            key("z", { ctrlKey: true });
            frame();
            check(`${name}: undo brings back every bit`, app.moves.every((move, k) => move === first[k]));
            for (const one of names) element(`lock_${one}`).click();
            back_to_start();
        }
        // For a small movement, the correction is parallel to the gradient of the area of the polygon of wall points.
        element("lock_area").click();
        app.movement.move_point(i, 0, 1e-5);
        const free = section.control.filter((k) => k !== i),
            given = free.flatMap((k) => [app.moves[2 * k], app.moves[2 * k + 1]]),
            { x0: x, y0: y } = app.model,
            n = section.points.length;
        const gradient = free.flatMap((k) => [0, 1].map((axis) => {
            const by = app.model.morph.displacement(app.moves.map((_, place) => (place === 2 * k + axis ? 1 : 0)));
            return section.points.reduce((sum, point, at) => {
                const after = section.points[(at + 1) % n],
                    before = section.points[(at + n - 1) % n];
                return sum + 0.5 * (by[2 * point] * (y[after] - y[before]) + by[2 * point + 1] * (x[before] - x[after]));
            }, 0);
        }));
        const product = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0),
            cosine = product(given, gradient) / Math.sqrt(product(given, given) * product(gradient, gradient));
        check("the correction is parallel to the gradient", Math.abs(cosine) > 1 - 1e-4, cosine);
        element("lock_area").click();
        back_to_start();
    };

    const comb = () => {
        const curve = app.curves.curves[0],
            [points, teeth] = app.curves.comb(curve, 1),
            pair = (all, k) => [all[2 * k], all[2 * k + 1]],
            between = (a, b) => [b[0] - a[0], b[1] - a[1]],
            inner = [...curve.u.keys()].slice(2, -2),
            end = pair(app.curves.control0, 0);
        // Angles between teeth and chords of the curve: the points beside them are near.
        const cosines = inner.map((k) => {
            const [tx, ty] = between(pair(points, k), pair(teeth, k)),
                [cx, cy] = between(pair(points, k - 1), pair(points, k + 1));
            return (tx * cx + ty * cy) / Math.hypot(tx, ty) / Math.hypot(cx, cy);
        });
        check("the teeth are at right angles to the curve", cosines.every((cosine) => Math.abs(cosine) < 0.1));
        const distance = (k) => Math.hypot(...between(pair(points, k), end)),
            farthest = inner.reduce((a, b) => (distance(a) > distance(b) ? a : b)),
            length = Math.hypot(...between(pair(points, farthest), pair(teeth, farthest))),
            ratio = (length / 0.02) ** 2 * app.sections[0].now.leading_edge_radius;
        check("the tooth at the leading edge has its radius", near(ratio, 1, 0.01), ratio);
        check("the tooth at the leading edge lies outside",
            Math.hypot(...between(pair(teeth, farthest), end)) > distance(farthest) + 0.99 * length);
        element("comb").click();
        frame();
        check("a button shows the comb", app.options.comb && element("comb").getAttribute("aria-pressed") === "true");
        element("comb").click();
    };

    const states = () => {
        const list = () => [...document.querySelectorAll("#states li button:first-child")];
        app.movement.move_point(3, 0.001, 0.02);
        element("state_name").value = 'thin "A": # 1';
        element("keep_state").click();
        const moves = app.moves.slice();
        back_to_start();
        element("keep_state").click();
        check("states are kept", list().map((button) => button.textContent).join("|") === 'thin "A": # 1|State 2');
        list()[0].click();
        frame();
        check("a kept state comes back", app.moves.every((move, k) => move === moves[k]) && !app.still);
        key("z", { ctrlKey: true });
        frame();
        check("and undo leaves it", app.still);
        const text = app.shape.text() + app.panel.design.states.text();
        for (const button of document.querySelectorAll("#states li button:last-child")) button.click();
        check("states can be deleted", list().length === 0);
        app.files.load(text);
        check("a saved file brings them back", list().length === 2);
        app.files.load(text.replace('"degrees"', '"turn"').replace('"points":[', '"points":[1,'));
        check("a state of another mesh is refused", /kept state/.test(element("message").textContent),
            element("message").textContent);
        for (const button of document.querySelectorAll("#states li button:last-child")) button.click();
        back_to_start();
    };

    // Joukowski's airfoil: the flow round a circle with the centre (-0.1, 0.08) through 1, mapped by z + 1 / z.
    const joukowski = (n, degrees) => {
        const [a, b] = [-0.1, 0.08],
            radius = Math.hypot(1 - a, b),
            beta = Math.asin(b / radius),
            alpha = (degrees * Math.PI) / 180;
        const nodes = Array.from({ length: n }, (_, i) => {
            const t = -beta + (2 * Math.PI * i) / n,
                [u, v] = [a + radius * Math.cos(t), b + radius * Math.sin(t)],
                square = u * u + v * v,
                slope = Math.hypot(1 - (u * u - v * v) / square ** 2, (2 * u * v) / square ** 2),
                speed = (2 * Math.sin(t - alpha) + 2 * Math.sin(alpha + beta)) / slope;
            return { x: u + u / square, y: v - v / square, cp: 1 - speed * speed };
        });
        const places = [...nodes.keys()],
            ring = new NodeRing(places, 0, nodes.map((node) => node.x), nodes.map((node) => node.y), n);
        return { nodes, ring, lift: (8 * Math.PI * radius * Math.sin(alpha + beta)) / ring.chord };
    };
    const pressure = () => {
        const errors = [100, 200].map((n) => {
            const { nodes, ring, lift } = joukowski(n, 4),
                flow = new Pressure([ring], 4);
            const differences = nodes.slice(1).map((node, i) => Math.abs(node.cp - flow.cp[i + 1]));
            check(`the lift of Joukowski's airfoil, ${n} panels`, near(flow.lift[0], lift, 1e-3 * lift), `${flow.lift[0]} ${lift}`);
            return differences.reduce((sum, value) => sum + value, 0) / n;
        });
        lines.push(`value joukowski_cp_error ${errors[1]}`);
        check("the pressure of Joukowski's airfoil", errors[1] < 2e-3, errors[1]);
        check("more panels are more exact", errors[1] < 0.4 * errors[0], errors);
        const { ring, lift } = joukowski(100, 4),
            moved = { ...ring, nodes: ring.nodes.map(({ x, y }) => ({ x: x + 5000, y: y + 900 })) },
            both = new Pressure([ring, moved], 4);
        check("two sections far apart", both.lift.every((value) => near(value, lift, 2e-3 * lift)), both.lift);
        const blunt = Array.from({ length: 120 }, (_, i) => {
            const c = Math.cos((2 * Math.PI * (i + 0.5)) / 120),
                x = 0.5 + 0.5 * c,
                side = i < 60 ? -1 : 1;
            return [x, side * (0.6 * (0.2969 * Math.sqrt(x) - 0.126 * x - 0.3516 * x ** 2 + 0.2843 * x ** 3 - 0.1015 * x ** 4) + 0.002)];
        });
        const open = new NodeRing([...blunt.keys()], 0, blunt.map(([x]) => x), blunt.map(([, y]) => y));
        check("a blunt trailing edge stays open", open.nodes.length === 120 && !open.is_sharp, open.nodes.length);
        const blunt_lift = new Pressure([open], 2).lift[0];
        check("and has the lift of a section of 12 %", near(blunt_lift, 0.24, 0.012), blunt_lift);
        element("design").open = true;
        element("pressure").click();
        const attack = element("attack");
        attack.value = "0";
        attack.dispatchEvent(new Event("input"));
        frame();
        const lift_of_page = () => Number(element("lift").textContent.replace("−", "-").match(/coefficient (-?\d+\.\d+)/)[1]);
        check("a symmetric section has no lift at 0 degrees", near(lift_of_page(), 0, 0.002), element("lift").textContent);
        attack.value = "2";
        attack.dispatchEvent(new Event("input"));
        check("and about 0.24 at 2 degrees", near(lift_of_page(), 0.24, 0.012), element("lift").textContent);
        app.movement.move_point(3, 0, 0.01);
        frame();
        check("the chart shows the pressure before and after", document.querySelectorAll("#pressure_chart polyline").length === 2);
        element("pressure").click();
        element("design").open = false;
        back_to_start();
    };

    try {
        for (const part of [several, mirrored, locks, comb, states, pressure]) part();
    } catch (error) {
        lines.push(`check script FAILED ${error.stack}`);
    }
    const result = document.createElement("pre");
    result.textContent = `\nresult begins\n${lines.join("\n")}\nresult ends\n`;
    document.body.append(result);
})();
