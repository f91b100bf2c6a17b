// usage: hostile.mjs FOLDER MESHES COUNT   The program of the workbench in FOLDER, in node, checks and fits damaged
// mesh files of several formats: each command ends, and says a sentence or what it found. Prints "N passed, M failed".
import fs from "node:fs";
import { createRequire } from "node:module";
import { damaged, numbers } from "./damage.mjs";
import { Checks } from "./steps.mjs";

const [folder, meshes, count] = process.argv.slice(2),
    require = createRequire(import.meta.url),
    make_program = require(`${fs.realpathSync(folder)}/workbench_program.js`),
    { run_command } = require("../../../c_api/web/workbench/command.js"),
    module = new WebAssembly.Module(fs.readFileSync(`${folder}/workbench_program.wasm`)),
    random = numbers(20261128),
    checks = new Checks();
// The program listens for exceptions that nobody catches, each time.
const run = async (words, files) => {
    const result = await run_command({ make_program, module, words, files, report: () => {} });
    for (const name of ["uncaughtException", "unhandledRejection"]) process.removeAllListeners(name);
    return result;
};

const block = new Uint8Array(fs.readFileSync(`${meshes}/block.su2`)),
    sources = [["mesh.su2", block]];
for (const name of ["mesh.msh", "mesh.vtk", "mesh.vtu"]) {
    const { made } = await run(["convert", "mesh.su2", name], [["mesh.su2", block.slice()]]);
    sources.push([name, made.find(([path]) => path === name)[1].slice()]);
}
checks.holds("a mesh in four formats", sources.length, 4);
const ways = new Set();
for (let k = 0; k < Number(count); ++k) {
    const [name, bytes] = sources[k % sources.length],
        file = damaged(bytes, random),
        begun = Date.now(),
        check = ["check", name, "--json", "--svg", "mesh.svg"],
        words = k % 5 === 4 ? ["fit", name, "--marker", "*", "-o", "wall.curve"] : check,
        { code, said, lines } = await run(words, [[name, file]]),
        seconds = (Date.now() - begun) / 1000,
        speaks = code === 0 ? said.length > 1 : lines.some((line) => /^harmorph: (?!warning).{10,}/.test(line));
    ways.add(code);
    if (code >= 0 && code <= 3 && speaks && seconds < 200) ++checks.passed;
    else checks.fail(`file ${k}, ${name}: exit code ${code} after ${seconds} s, ${lines.join("; ")}`);
}
// Damage that nobody would notice tests nothing, nor does noise alone.
checks.holds("some files are refused, and some are not", [ways.has(0), ways.has(3)], [true, true]);
checks.finish();
