// usage: use.mjs CHROMIUM WORKBENCH FOLDER   Uses the workbench as an engineer does: drops FOLDER/naca0012.su2, fits,
// solves, drags a control point with the mouse, morphs, and saves files, which are in FOLDER/saved afterwards. Prints
// "N passed, M failed".
import fs from "node:fs";
import path from "node:path";
import { Browser } from "./devtools.mjs";
import { Checks, labels, steps } from "./steps.mjs";

const [chromium, workbench, folder] = process.argv.slice(2),
    saved = path.join(folder, "saved"),
    checks = new Checks();
fs.mkdirSync(saved, { recursive: true });
const browser = await Browser.start(chromium),
    { page } = browser,
    bench = steps(page);
await browser.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: saved });
await page.open(`file://${workbench}`);

// Saves a file of the list, which is renamed afterwards.
const save = async (name, to = name) => {
    const button = `[...document.querySelectorAll("#files button")].find((one) => one.textContent === "${name}")`;
    await page.value(`${button}.click()`);
    await arrives(name);
    fs.renameSync(path.join(saved, name), path.join(saved, to));
};
const arrives = async (name) => {
    const file = path.join(saved, name);
    for (const end = Date.now() + 10000; Date.now() < end; ) {
        if (fs.existsSync(file)) return;
        await new Promise((done) => setTimeout(done, 20));
    }
    throw new Error(`${name} is not saved`);
};

try {
    checks.holds("names and roles at the start", await page.value(`(${labels})()`), []);
    await bench.drop([path.join(folder, "naca0012.su2")]);
    const guess = "[...bench.boundary.guessed].map(({ name }) => name).join()",
        is_shown = "!element('view').hidden && element('picture').naturalWidth > 100";
    checks.holds("the wall is a guess", await page.value(guess), "airfoil");
    checks.holds("the guess is marked", await page.value("document.querySelector('#pieces em').textContent"), "guess");
    checks.holds("the mesh is shown", await page.value(is_shown), true);
    checks.holds("names and roles of the mesh", await page.value(`(${labels})()`), []);

    // Cancelled, and once more.
    await page.value(`bench.program.run('A long one', ['solve', 'naca0012.su2', '--rigid', 'airfoil',
        '--repeat', '100000', '-o', 'x.basis'], bench.files).then(() => { window.ended = 'done'; },
        (error) => { window.ended = error.message; }); 0`);
    await page.until("!element('work').hidden && bench.program.worker !== null");
    await page.click("#cancel");
    await page.until("window.ended !== undefined", 10);
    checks.holds("a command is cancelled", await page.value("window.ended"), "cancelled");

    await bench.fit();
    const frame = await bench.solve();
    // A control point goes up by 20 pixels.
    const [x, y, scale] = await frame.value(`(() => {
        const box = element("handles").getBoundingClientRect(), { control } = app.curves, at = 2 * 15;
        return [box.left + app.camera.pixel_x(control[at]),
        box.top + app.camera.pixel_y(control[at + 1]), app.camera.scale]; })()`);
    const [left, top] = await page.value(`(() => { const { left, top } = document.querySelector("#page_box iframe")
        .getBoundingClientRect(); return [left, top]; })()`);
    const at = [left + x, top + y];
    await page.mouse("mouseMoved", ...at);
    await page.mouse("mousePressed", ...at);
    for (let step = 1; step <= 5; ++step) await page.mouse("mouseMoved", at[0], at[1] - 4 * step, { buttons: 1 });
    await page.mouse("mouseReleased", at[0], at[1] - 20);
    await frame.until("!app.must_follow && !app.still");
    const moved = await frame.value("app.moves[2 * 15 + 1]");
    checks.near("the point is where the mouse has dragged it", moved, 20 / scale, 2 / scale);
    checks.holds("no script failed on the page", frame.errors, []);

    await bench.open_tab("save");
    const moves = await page.value("element('moves').value");
    checks.holds("the movement is there", moves.includes(`\n16 0 ${moved}\n`), true);
    await bench.morph();
    checks.holds("the mesh is valid", await page.value("element('verdict').className"), "good");
    await save("naca0012-morphed.su2", "moved.su2");
    // Chromium lets a page save ten files by itself, which are those whose bytes the tests compare.
    for (const name of ["moves.txt", "airfoil.curve", "mesh.basis", "naca0012-morphed.su2.curve"]) await save(name);
    const offered = "[...document.querySelectorAll('#files button')].map((one) => one.textContent)";
    for (const name of ["morph.svg", "report.html"])
        checks.holds(`${name} is offered`, (await page.value(offered)).includes(name), true);
    for (const [format, name] of [[".igs", "naca0012-morphed.su2.igs"], [".step", "naca0012-morphed.su2.step"],
        [".dat", "naca0012-morphed.su2.dat"]]) {
        await page.value(`element("curve_format").value = "${format}"`);
        await page.click("#save_curve");
        await arrives(name);
    }
    checks.holds("names and roles of the results", await page.value(`(${labels})()`), []);

    // The report is shown, and the picture again.
    await page.click("#shown [data-value=report]");
    await page.until("!element('report_box').hidden && element('report_box').firstChild !== null", 10);
    await page.click("#shown [data-value=picture]");
    checks.holds("the picture is back", await page.value("!element('view').hidden"), true);

    // Another airfoil, flap, a safe morph.
    await bench.drop_beside(path.join(folder, "other.dat"), "airfoil");
    await bench.morph();
    checks.holds("to another airfoil", await page.value("element('verdict').className"), "good");
    await save("naca0012-morphed.su2", "other.su2");
    await page.click("#how [data-value=moves]");
    await page.value(`element('moves').value = ''; element('line_kind').value = 'flap';
        element('line_kind').onchange()`);
    await page.click("#line_add");
    checks.holds("a line of a flap", await page.value("element('moves').value"), "flap airfoil 0.75,0 5\n");
    await page.value("element('safe').checked = true");
    await bench.morph();
    checks.holds("a flap, safely", await page.value("element('verdict').className"), "good");
    await bench.drop_beside(path.join(folder, "wall.txt"), "table");
    await bench.morph();
    checks.holds("displacements of the wall", await page.value("element('verdict').className"), "good");
    // A compressed mesh, whose airfoil is a rigid body.
    await bench.drop([path.join(folder, "packed.su2.gz")]);
    checks.holds("the mesh is unpacked", await page.value("bench.mesh"), "packed.su2");
    await page.value(`(() => { const role = element("role_0"); role.value = "rigid"; role.onchange(); })()`);
    await bench.solve();
    await bench.open_tab("save");
    checks.holds("a body's line", (await page.value("element('moves').value")).includes("rigid airfoil 0 0 0 1"), true);
    await page.value("element('moves').value = 'rigid airfoil 0.01 0.02 3'");
    await bench.morph();
    checks.holds("a rigid body", await page.value("element('verdict').className"), "good");
    await save("packed-morphed.su2");
    checks.holds("nothing is loaded", page.requests.filter((url) => !/^(file|blob|data|about):/.test(url)), []);
    checks.holds("no script failed", page.errors, []);
} catch (error) {
    checks.fail(`the script: ${error.message}; ${await page.value("element('message').innerText").catch(() => "")}`);
}
await browser.close();
checks.finish();
