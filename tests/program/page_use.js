"use strict";
// Does on the page of `harmorph explore` what a user meets: fingers, typed numbers, walls that cross themselves,
// keyboard and screen reader, what is drawn. Leaves lines "check NAME ok" or "check NAME FAILED ..." as page.js does.
(async () => {
    const lines = [];
    const check = (name, holds, found = "") => lines.push(`check ${name} ${holds ? "ok" : `FAILED ${found}`}`);
    const handles = document.getElementById("handles");
    const frame = () => {
        if (app.must_follow) app.follow();
        app.draw();
    };
    const finger = (type, id, [x, y]) => {
        const box = handles.getBoundingClientRect();
        const at = { clientX: box.left + x, clientY: box.top + y };
        handles.dispatchEvent(
            new PointerEvent(type, { pointerId: id, pointerType: "touch", bubbles: true, ...at }));
    };
    const key = (target, name) =>
        target.dispatchEvent(
            new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true }));
    const place_of = (i) => [
        app.camera.pixel_x(app.curves.control[2 * i]),
        app.camera.pixel_y(app.curves.control[2 * i + 1]),
    ];
    const type = (id, text) => {
        const field = element(id);
        field.value = text;
        field.dispatchEvent(new Event("input"));
        const is_wrong = field.classList.contains("wrong");
        field.dispatchEvent(new Event("change"));
        return is_wrong;
    };
    const back_to_start = () => {
        element("reset").click();
        frame();
    };

    const fingers = () => {
        const [x, y] = place_of(4);
        finger("pointerdown", 1, [x, y]);
        finger("pointermove", 1, [x, y + 30]);
        finger("pointerdown", 2, [x + 90, y]);
        finger("pointermove", 2, [x + 120, y]);
        finger("pointerup", 2, [x + 120, y]);
        finger("pointerup", 1, [x, y + 30]);
        frame();
        const moved = app.moves.slice();
        check("a dragged point stays where a second finger ends the drag", moved[9] !== 0);
        element("undo").click();
        frame();
        check("undo takes this movement back", app.moves.every((move) => move === 0));
        element("redo").click();
        frame();
        check("and redo brings it again", app.moves.every((move, k) => move === moved[k]));
        app.movement.move_point(1, 0, 0.001);
        app.commit();
        app.movement.move_point(2, 0, 0.001); // as in the middle of a drag
        element("undo").click();
        element("redo").click();
        frame();
        check("undo loses nothing that is not finished", app.moves[5] === 0.001, app.moves[5]);
        back_to_start();
        app.view.fit();
    };

    const numbers = () => {
        app.selection.choose(3);
        const exact = 0.0123456789012345;
        app.movement.move_point(3, 0, exact);
        app.commit();
        frame();
        check("a decimal comma is no error", !type("dx", "0,00125"));
        check("and counts", app.moves[6] === 0.00125, app.moves[6]);
        type("dx", "0.00125");
        check("the other number keeps all its digits", app.moves[7] === exact, app.moves[7]);
        check("a minus of print is no error", !type("dx", "\u22120.0025"));
        check("and counts", app.moves[6] === -0.0025, app.moves[6]);
        for (const text of ["", "1e", "0,1,2", "--1", "Infinity"]) {
            check(`"${text}" is an error`, type("dx", text));
            check("which moves nothing", app.moves[6] === -0.0025, app.moves[6]);
        }
        back_to_start();
    };

    // A movement that takes one wall through another without inverting a cell.
    const crossing = () => {
        const find = () => {
            for (let i = 0; i < app.data.n_control; ++i) {
                for (const dy of [-0.2, 0.2]) {
                    back_to_start();
                    app.movement.move_point(i, 0, dy);
                    frame();
                    if (app.wall.crossing.length > 0 && app.cells.inverted === 0) return [i, dy];
                }
            }
            return null;
        };
        const found = find();
        check("a movement through the other wall", found !== null);
        if (found === null) return;
        app.commit();
        const step = Number(element("step").textContent.split(" ")[0]);
        check("less than this movement is admissible", step < 1, step);
        check("the verdict says which part", element("verdict_detail").textContent.includes("% of this movement"));
        element("save").click();
        const said = element("message").textContent;
        check("no option is advised that cannot help", !/--(force|safe)/.test(said), said);
        const [i, dy] = found,
            exact = app.admissible_step();
        for (const [factor, crosses] of [[0.25, 0], [0.5, 0], [0.75, 0], [0.9999, 0], [1.0001, 1]]) {
            app.movement.move_point(i, 0, factor * exact * dy);
            frame();
            check(`at ${factor} of the admissible step the wall ${crosses ? "crosses" : "does not cross"} itself`,
                app.wall.crossing.length > 0 === (crosses === 1));
        }
        app.commit();
        element("back_to_valid").click();
        frame();
        check("back to the last valid position", app.is_valid() && !app.still);
        element("undo").click();
        frame();
        check("which can be undone", !app.is_valid());
        back_to_start();
    };

    const screen_reader = async () => {
        const spoken = () => element("spoken").textContent;
        app.selection.choose(-1);
        key(handles, "Tab");
        check("choosing a point is announced", spoken().includes("Control point 1"), spoken());
        for (let i = 0; i < 20; ++i) key(handles, "ArrowUp");
        check("the verdict is announced", spoken().includes(element("verdict_word").textContent), spoken());
        check("the verdict is announced by a live region", element("spoken").getAttribute("role") === "status");
        check("the gauge is a meter", element("gauge").getAttribute("role") === "meter" &&
            Number(element("gauge").getAttribute("aria-valuenow")) > 0);
        handles.focus({ focusVisible: true });
        check("the keyboard's focus on the mesh is seen", getComputedStyle(handles).outlineStyle === "solid");
        const nameless = [...document.querySelectorAll("aside input:not([type=file]), button")].filter((node) => {
            const name = node.getAttribute("aria-label") || node.textContent.trim() || node.title ||
                (node.labels && [...node.labels].map((label) => label.textContent).join(""));
            return !/[A-Za-z]/.test(name || "");
        });
        check("everything has a name in letters", nameless.length === 0, nameless.map((node) => node.outerHTML).join());
        for (const group of document.querySelectorAll("[role=radiogroup]")) {
            const stops = [...group.children].filter((button) => button.tabIndex === 0);
            check(`one stop for Tab in ${group.id}`, stops.length === 1, stops.length);
        }
        const quality = document.querySelector("#colour [data-value=quality]");
        key(document.querySelector("#colour [data-value=none]"), "ArrowRight");
        check("arrow keys choose the next colour", app.options.colour === "quality" && document.activeElement === quality);
        document.querySelector("#colour [data-value=none]").click();
        const problems = typeof axe === "undefined" ? [] : (await axe.run(document)).violations;
        check("axe finds nothing", problems.length === 0, problems.map((node) => `${node.id} ${node.help}`).join("; "));
        back_to_start();
    };

    const bodies = () => {
        app.selection.choose(-1);
        for (let i = 0; i <= app.data.n_control; ++i) key(handles, "Tab");
        check("Tab comes to the first body", app.selection.body === 0, app.selection.body);
        check("and says so", element("spoken").textContent.includes(app.data.bodies[0].marker));
        key(handles, "ArrowUp");
        frame();
        check("an arrow key moves the body", app.shape.state.bodies[0].y > 0);
        type("dy", "0,25");
        check("and so does a typed number", app.shape.state.bodies[0].y === 0.25, app.shape.state.bodies[0].y);
        back_to_start();
        app.camera.zoom(0.01);
        check("the handle of a small body is small", app.view.body_handle(0).radius < 40, app.view.body_handle(0).radius);
        app.view.fit();
        check("the keys say how to turn a body", /turn a body/.test(element("keys").textContent));
    };

    const section = () => {
        const { now } = app.sections[0];
        for (const name of ["leading_edge_radius", "trailing_edge_angle"]) lines.push(`value ${name} ${now[name]}`);
        lines.push("section", app.sections[0].text().trimEnd(), "end");
        const caption = element("section_name");
        check("the table says of which section, if there are several", caption.hidden === (app.sections.length === 1) &&
            caption.textContent === app.selection.section().name);
    };

    const pointer = () => {
        const [clientX, clientY] = place_of(2);
        const box = handles.getBoundingClientRect();
        handles.dispatchEvent(new PointerEvent("pointermove",
            { pointerId: 7, clientX: clientX + box.left, clientY: clientY + box.top }));
        check("a point under the pointer has a halo", app.selection.hovered === 2, app.selection.hovered);
        handles.dispatchEvent(new PointerEvent("pointerleave", { pointerId: 7 }));
        check("until the pointer leaves", app.selection.hovered === -1, app.selection.hovered);
        app.selection.choose(-1);
        const look = (field) => getComputedStyle(field).opacity;
        check("a disabled field looks disabled", Number(look(element("dx"))) < 0.6, look(element("dx")));
    };

    // Both painters put the same colour at the centre of a pixel, and each cell that has one is filled.
    const painters = () => {
        app.movement.move_point(3, 0, 0.02);
        frame();
        const { picture, camera, data } = app,
            of_page = picture.painter;
        const pixels = (Painter) => {
            const canvas = document.createElement("canvas"),
                painter = new Painter(canvas, data.pieces.points, { antialias: false, preserveDrawingBuffer: true });
            painter.begin(camera.width, camera.height, 1, [1, 1, 1]);
            painter.place(picture.screen);
            painter.fill_cells(picture.values_of_pieces(true), scales.light.good, [1, 0, 0]);
            painter.end();
            const copy = document.createElement("canvas");
            Object.assign(copy, { width: canvas.width, height: canvas.height });
            copy.getContext("2d").drawImage(canvas, 0, 0);
            return copy.getContext("2d").getImageData(0, 0, copy.width, copy.height).data;
        };
        const [one, other] = [GlPainter, CanvasPainter].map(pixels);
        let filled = 0,
            differ = 0;
        for (let i = 0; i < one.length; i += 4) {
            if (other[i] + other[i + 1] + other[i + 2] < 765) ++filled;
            if (Math.abs(one[i] - other[i]) + Math.abs(one[i + 1] - other[i + 1]) > 6) ++differ;
        }
        check("cells cover the canvas round the body", filled > 0.85 * camera.width * camera.height, filled);
        check("both painters agree", differ < 0.002 * one.length / 4, `${differ} pixels`);
        picture.painter = of_page;
        back_to_start();
    };

    const text = document.querySelector("noscript").textContent;
    check("a page without JavaScript says so", /needs JavaScript/.test(text) && /display: none/.test(text));
    const rules = [...document.styleSheets].flatMap((sheet) => [...sheet.cssRules]);
    check("there are rules for print", rules.some((rule) => rule.conditionText === "print"));
    if (app.data.n_control > 0) for (const part of [fingers, numbers, crossing, pointer, painters]) part();
    if (app.sections.length > 0) section();
    if (app.data.bodies.length > 0) bodies();
    else await screen_reader();
    return lines;
})()
    .catch((error) => [`check script FAILED ${error.stack}`])
    .then((lines) => {
        const result = document.createElement("pre");
        result.textContent = `\nresult begins\n${lines.join("\n")}\nresult ends\n`;
        document.body.append(result);
    });
