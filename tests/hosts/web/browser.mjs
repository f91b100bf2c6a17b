// usage: node browser.mjs CHROMIUM FOLDER SCRIPT ARGUMENTS...   Runs the module SCRIPT of FOLDER in headless Chromium,
// with the package in FOLDER/package, and prints what it says. SCRIPT exports run(load, arguments, say).
import { spawn } from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";

const [chromium, folder, script, ...rest] = process.argv.slice(2);
const TYPES = { ".js": "text/javascript", ".mjs": "text/javascript", ".wasm": "application/wasm" };
const PAGE = `<!doctype html><title>harmorph</title><script type="module">
const say = (line) => fetch("/said", { method: "POST", body: line });
try {
    const { load } = await import("/package/index.js");
    const { run } = await import(${JSON.stringify(`/${script}`)});
    const lines = [];
    await run(load, ${JSON.stringify(rest)}, (line) => lines.push(line));
    await say(lines.join("\\n"));
} catch (error) {
    await say("FAILED " + error.stack);
}
</script>`;

const server = http.createServer((request, response) => {
    if (request.method === "POST") {
        let text = "";
        request.on("data", (part) => (text += part)).on("end", () => finish(text));
        return response.end();
    }
    if (request.url === "/") return response.setHeader("content-type", "text/html").end(PAGE);
    const file = path.join(folder, path.normalize(decodeURIComponent(request.url.split("?")[0])));
    if (!fs.existsSync(file)) return response.writeHead(404).end();
    response.setHeader("content-type", TYPES[path.extname(file)] ?? "text/plain");
    return response.end(fs.readFileSync(file));
});
await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
const profile = fs.mkdtempSync(path.join(os.tmpdir(), "harmorph-browser-"));
const child = spawn(chromium, ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
    `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/`], { stdio: "ignore" });
const limit = setTimeout(() => finish("FAILED no answer within 300 s"), 300000);

function finish(text) {
    clearTimeout(limit);
    console.log(text);
    process.exitCode = text.startsWith("FAILED") ? 1 : 0;
    child.once("exit", () => {
        fs.rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
        server.closeAllConnections();
        server.close();
    });
    child.kill();
}
