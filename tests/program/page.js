"use strict";
// Drives the page of `harmorph explore` as a user would, with pointer and key events, before the browser calls it
// loaded; leaves its findings as text of the element `result`: lines "check NAME ok" or "check NAME FAILED ...", "value
// NAME NUMBER", "moves" with the saved file, and "point INDEX X Y", with which `harmorph morph` must agree.
(() => {
    const lines = [];
    const check = (name, holds, found = "") => lines.push(`check ${name} ${holds ? "ok" : `FAILED ${found}`}`);
    const handles = document.getElementById("handles");
    window.addEventListener("error", (event) => lines.push(`check script FAILED ${event.message}`));

    const pointer = (type, px, py, extra = {}) => {
        const box = handles.getBoundingClientRect();
        handles.dispatchEvent(
            new PointerEvent(type, {
                pointerId: 1,
                pointerType: "mouse",
                clientX: box.left + px,
                clientY: box.top + py,
                bubbles: true,
                ...extra,
            }),
        );
    };
    const key = (name, extra = {}) =>
        handles.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true, cancelable: true, ...extra }));
    // The frame that the page would draw next, now.
    const frame = () => {
        if (app.must_follow) app.follow();
        app.draw();
    };
    const coordinates = () => app.model.x.join() + app.model.y.join();
    const pixel_of = (i) => [
        app.camera.pixel_x(app.curves.control[2 * i]),
        app.camera.pixel_y(app.curves.control[2 * i + 1]),
    ];

    // Drags from one pixel by some others in steps, and draws a frame for each step. Returns median times [ms] of a
    // frame and of the parts of a frame.
    const drag = ([px, py], dx, dy, steps) => {
        const times = { frame: [], morph: [], judge: [], draw: [] };
        pointer("pointerdown", px, py);
        for (let i = 1; i <= steps; ++i) {
            const begin = performance.now();
            pointer("pointermove", px + (dx * i) / steps, py + (dy * i) / steps);
            frame();
            app.picture.painter.finish();
            times.frame.push(performance.now() - begin);
            for (const part of ["morph", "judge", "draw"]) times[part].push(app.times[part]);
        }
        pointer("pointerup", px + dx, py + dy);
        return Object.entries(times).map(([part, list]) => [part, list.sort((a, b) => a - b)[steps >> 1]]);
    };

    const saved = () => {
        const Blob_of_page = window.Blob,
            make_url = URL.createObjectURL;
        let text = "";
        window.Blob = function (parts) {
            text = parts.join("");
        };
        URL.createObjectURL = () => "#";
        document.getElementById("save").click();
        window.Blob = Blob_of_page;
        URL.createObjectURL = make_url;
        return text;
    };

    const drag_control_points = () => {
        const i = Math.floor(app.data.n_control / 3),
            start = coordinates();
        for (const [part, milliseconds] of drag(pixel_of(i), 10, wanted.down, 40))
            lines.push(`value ${part}_milliseconds ${milliseconds.toFixed(1)}`);
        const shift = wanted.down / app.camera.scale;
        check(
            "a dragged point is where the pointer is",
            Math.abs(app.moves[2 * i + 1] + shift) <= app.movement.digit,
            app.moves[2 * i + 1],
        );
        const dragged = coordinates();
        check("the mesh follows", dragged !== start);
        key("z", { ctrlKey: true });
        frame();
        check("undo brings back every bit", coordinates() === start);
        key("y", { ctrlKey: true });
        frame();
        check("redo does, too", coordinates() === dragged);
        app.selection.choose(-1);
        key("Tab");
        check("Tab chooses the first point", app.selection.point === 0, app.selection.point);
        key("ArrowUp");
        frame();
        check("an arrow key moves it", app.moves[1] > 0, app.moves[1]);
        const field = document.getElementById("dx");
        field.value = "0.00123";
        field.dispatchEvent(new Event("input"));
        field.dispatchEvent(new Event("change"));
        frame();
        check("a typed number is its movement", app.moves[0] === 0.00123, app.moves[0]);
        pairs();
        slider();
        pinch();
    };

    const pairs = () => {
        const i = [...app.pairs.partner.keys()].find((index) => app.pairs.partner[index] >= 0);
        if (i === undefined) return;
        const j = app.pairs.partner[i],
            before = app.moves.slice();
        document.querySelector("#pair [data-value=mirror]").click();
        const px = pixel_of(i);
        drag(px, 0, -20, 3);
        const moved = app.moves[2 * i + 1] - before[2 * i + 1],
            across = app.moves[2 * j + 1] - before[2 * j + 1];
        check(
            "the point across moves the other way",
            Math.abs(moved + across) <= 2 * app.movement.digit && moved !== 0,
            `${moved} ${across}`,
        );
        document.querySelector("#pair [data-value=alone]").click();
        key("z", { ctrlKey: true });
        frame();
        check(
            "and back",
            app.moves.every((move, k) => move === before[k]),
        );
    };

    // Two fingers that part to twice their distance.
    const pinch = () => {
        const before = app.camera.scale,
            moves = app.moves.join(),
            finger = (type, id, x) => pointer(type, x, 40, { pointerId: id, pointerType: "touch" });
        finger("pointerdown", 1, 300);
        finger("pointerdown", 2, 400);
        finger("pointermove", 1, 250);
        finger("pointermove", 2, 450);
        finger("pointerup", 1, 250);
        finger("pointerup", 2, 450);
        frame();
        const zoom = app.camera.scale / before;
        check("two fingers zoom", Math.abs(zoom - 2) < 1e-9 && app.moves.join() === moves, zoom);
        app.view.fit();
        frame();
    };

    const slider = () => {
        const range = document.querySelector("#sliders input[type=range]");
        if (!range || app.sections.length === 0) return;
        if (!app.is_valid()) return;
        const before = app.sections[0].now.thickness;
        range.value = 10;
        range.dispatchEvent(new Event("input"));
        range.dispatchEvent(new Event("change"));
        frame();
        const ratio = app.sections[0].now.thickness / before;
        check("10 % more thickness", Math.abs(ratio - 1.1) < 0.02, ratio);
    };

    const drag_body = () => {
        const handle = app.view.body_handle(0),
            start = coordinates();
        drag([app.camera.pixel_x(handle.x), app.camera.pixel_y(handle.y)], 12, -9, 5);
        const body = () => app.shape.state.bodies[0];
        check("a body is where the pointer is", Math.abs(body().x - 12 / app.camera.scale) <= app.movement.digit, body().x);
        const moved = app.view.body_handle(0);
        drag([moved.knob_x, moved.knob_y], -14, -30, 5); // up, so counter-clockwise
        check("its knob turns it", body().degrees > 10, body().degrees);
        key("z", { ctrlKey: true });
        key("z", { ctrlKey: true });
        frame();
        check("undo brings back every bit", coordinates() === start);
        key("y", { ctrlKey: true });
        key("y", { ctrlKey: true });
        frame();
    };

    // Does it draw at all? Lines and cells, not the background alone.
    const draws = (painter) => {
        const { picture } = app,
            painter_of_page = picture.painter,
            { canvas } = painter;
        picture.painter = painter;
        document.body.append(canvas);
        picture.draw(app.camera, 1, { ...app.options, colour: "quality", before: true });
        const copy = document.createElement("canvas"),
            context = copy.getContext("2d");
        copy.width = canvas.width;
        copy.height = canvas.height;
        context.drawImage(canvas, 0, 0);
        const pixels = new Set(new Uint32Array(context.getImageData(0, 0, copy.width, copy.height).data.buffer));
        canvas.remove();
        picture.painter = painter_of_page;
        return pixels.size;
    };
    // The pieces of a cell cover the cell, also of one that is not convex or has a point on a side.
    const covers = (set, x, y) => {
        const { start, points } = pieces_of(set, x, y), cells = new Cells(set, new Float64Array(start.length - 1));
        const size = ([a, b, c, d]) => Math.abs(twice_area(a, b, c, x, y)) + Math.abs(twice_area(c, d, a, x, y));
        return cells.quality.every((_, cell) => {
            let sum = 0;
            for (let k = start[cell]; k < start[cell + 1]; ++k) sum += size(points.subarray(4 * k, 4 * k + 4)) / 2;
            return Math.abs(sum / cells.size(cell, x, y) ** 2 - 1) < 1e-9;
        });
    };
    check("pieces", covers(app.data, app.data.x, app.data.y));
    const of_polygons = (...polygons) => {
        const start = [0];
        for (const polygon of polygons) start.push(start[start.length - 1] + polygon.length);
        const all = polygons.flat(), [x, y] = [0, 1].map((axis) => all.map((point) => point[axis]));
        return covers({ cell_start: Int32Array.from(start), cell_points: Int32Array.from(all.keys()) }, x, y);
    };
    const angle = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], arrow = [[0, 0], [2, 0], [0.5, 0.5], [0, 2]],
        hanging = [[0, 0], [2, 0], [2, 1], [2, 2], [0, 2]];
    check("pieces of polygons that are not convex", of_polygons(angle, arrow, hanging) &&
        of_polygons(...[angle, arrow, hanging].map((polygon) => polygon.slice().reverse())));
    check("the sine", [0, 1e-9, 0.5, 2, -4, 99].every((at) => Math.abs(sine_cosine(at)[0] - Math.sin(at)) < 2e-16));
    for (const Painter of [GlPainter, CanvasPainter]) {
        const colours = draws(new Painter(document.createElement("canvas"), app.data.pieces.points, {}));
        check(`${Painter.name} draws cells`, colours > 3, `${colours} colours`);
    }
    if (app.data.n_control > 0) drag_control_points();
    if (app.data.bodies.length > 0) drag_body();
    for (const colour of ["quality", "angle", "height", "function", "none"]) {
        document.querySelector(`#colour [data-value=${colour}]`).click();
        frame();
    }
    document.getElementById("state_name").value = 'a "state" # 1';
    document.getElementById("keep_state").click();
    const text = saved(),
        moves = app.moves.slice(),
        here = coordinates();
    document.getElementById("reset").click();
    frame();
    check("reset: nothing has moved", app.still);
    app.files.load("1 0\n");
    check(
        "a file that is none changes nothing",
        app.moves.every((move) => move === 0),
    );
    app.files.load(text);
    frame();
    check(
        "a saved file gives the same movements",
        app.moves.every((move, k) => move === moves[k]),
    );
    check("and the same mesh", coordinates() === here);
    const { cells, wall, model } = app;
    lines.push(
        `value inverted ${cells.inverted}`,
        `value admissible_step ${app.admissible_step()}`,
        `value min_quality ${cells.min_quality}`,
    );
    lines.push(`value mean_quality ${cells.mean_quality}`, `value self_crossing ${wall.crossing.length > 0}`);
    lines.push("moves", text.trimEnd(), "end");
    for (let k = 0; k < model.n; ++k) lines.push(`point ${k} ${model.x[k]} ${model.y[k]}`);
    const result = document.createElement("pre");
    result.id = "result";
    result.textContent = `\nresult begins\n${lines.join("\n")}\nresult ends\n`;
    document.body.append(result);
})();
