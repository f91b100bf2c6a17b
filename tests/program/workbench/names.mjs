// usage: names.mjs CHROMIUM WORKBENCH MESH FOLDER   Names of files and markers that are markup, and damaged files, in
// the workbench: names are shown as text, no script runs, each file ends in a mesh or a sentence. Prints "N passed, M
// failed".
import fs from "node:fs";
import path from "node:path";
import { Browser } from "./devtools.mjs";
import { damaged, numbers } from "./damage.mjs";
import { Checks, steps } from "./steps.mjs";

const [chromium, workbench, mesh, folder] = process.argv.slice(2),
    checks = new Checks(),
    bytes = fs.readFileSync(mesh),
    marker = "</script><img src=x onerror=alert(1)>",
    named = path.join(folder, `"><img src=x onerror=alert(2)> & 'x'.su2`);
fs.writeFileSync(named, bytes.toString().replace("MARKER_TAG= airfoil", `MARKER_TAG= ${marker}`));
const browser = await Browser.start(chromium),
    { page } = browser,
    bench = steps(page);
await page.open(`file://${workbench}`);
const markup = "document.querySelectorAll('img[src=x]').length";
try {
    await bench.drop([named]);
    checks.holds("the name of the marker is text", await page.value("bench.boundary.pieces[0].name"), marker);
    const is_shown = "element('pieces').textContent.includes(bench.boundary.pieces[0].name)";
    checks.holds("and is shown", await page.value(is_shown), true);
    await bench.fit();
    const frame = await bench.solve();
    await bench.open_tab("save");
    await bench.morph();
    checks.holds("the mesh is valid", await page.value("element('verdict').className"), "good");
    await page.click("#shown [data-value=report]");
    await page.until("!element('report_box').hidden && element('report_box').firstChild !== null", 10);
    await new Promise((done) => setTimeout(done, 300));
    for (const [what, session] of [["workbench", page], ["page", frame], ...page.frames.map((one) => ["frame", one])])
        checks.holds(`no markup from names, ${what}`, await session.value(markup), 0);
    const random = numbers(62);
    for (let k = 0; k < 12; ++k) {
        const file = path.join(folder, `damaged-${k}.su2`);
        fs.writeFileSync(file, damaged(bytes, random));
        await bench.drop([file]);
        const says = await bench.message();
        if (says === "" || says.includes(`damaged-${k}.su2`)) ++checks.passed;
        else checks.fail(`damaged file ${k}: ${says}`);
    }
    checks.holds("no script of a file runs", page.dialogs + page.frames.reduce((sum, one) => sum + one.dialogs, 0), 0);
    checks.holds("no script failed", page.errors, []);
    checks.holds("nothing is loaded", page.requests.filter((url) => !/^(file|blob|data|about):/.test(url)), []);
} catch (error) {
    checks.fail(`the script: ${error.message}; ${await bench.message().catch(() => "")}`);
}
await browser.close();
checks.finish();
