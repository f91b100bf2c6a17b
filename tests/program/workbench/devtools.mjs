// Drives headless Chromium by the devtools protocol, through pipes: real events of the mouse and the keyboard.
import { spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

export class Browser {
    // The browser has nothing to look up: names of hosts lead nowhere.
    static async start(chromium, { width = 1280, height = 800, flags = [] } = {}) {
        const browser = new Browser();
        browser.profile = fs.mkdtempSync(path.join(os.tmpdir(), "harmorph-workbench-"));
        browser.child = spawn(chromium, ["--headless", "--no-sandbox", "--no-first-run", "--disable-quic",
            "--disable-gpu", "--disable-background-networking", "--disable-component-update",
            "--disable-sync", "--disable-dev-shm-usage", "--remote-debugging-pipe",
            `--window-size=${width},${height}`, `--user-data-dir=${browser.profile}`, ...flags, "about:blank"],
        { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
        browser.listen();
        const { targetInfos } = await browser.send("Target.getTargets");
        const { targetId } = targetInfos.find(({ type }) => type === "page");
        const { sessionId } = await browser.send("Target.attachToTarget", { targetId, flatten: true });
        browser.page = new Session(browser, sessionId);
        await browser.page.prepare();
        await browser.page.send("Emulation.setDeviceMetricsOverride",
            { width, height, deviceScaleFactor: 1, mobile: false });
        return browser;
    }
    listen() {
        this.number = 0;
        this.answers = new Map();
        this.listeners = [];
        const chunks = [];
        this.child.stdio[4].on("data", (data) => {
            let from = 0;
            for (let end; (end = data.indexOf(0, from)) >= 0; from = end + 1) {
                chunks.push(data.subarray(from, end));
                this.take(JSON.parse(Buffer.concat(chunks.splice(0)).toString()));
            }
            if (from < data.length) chunks.push(data.subarray(from));
        });
        this.child.stdio[3].on("error", () => {});
        this.ended = new Promise((done) => this.child.once("exit", done));
        this.ended.then(() => {
            for (const { fail } of this.answers.values()) fail(new Error("the browser has ended"));
        });
    }
    take(message) {
        const { id, method, params, sessionId, error, result } = message;
        if (id === undefined) {
            for (const listener of this.listeners) listener(method, params, sessionId);
            return;
        }
        const { done, fail } = this.answers.get(id);
        this.answers.delete(id);
        if (error) fail(new Error(error.message));
        else done(result);
    }
    send(method, params = {}, sessionId = undefined) {
        const id = ++this.number;
        return new Promise((done, fail) => {
            this.answers.set(id, { done, fail });
            this.child.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
        });
    }
    // Processes of the browser may write to its folder a little longer than the browser lives.
    async close() {
        const killer = setTimeout(() => this.child.kill("SIGKILL"), 10000);
        await this.send("Browser.close").catch(() => {});
        await this.ended;
        clearTimeout(killer);
        for (let trial = 0; fs.existsSync(this.profile) && trial < 20; ++trial) {
            try {
                fs.rmSync(this.profile, { recursive: true, force: true });
            } catch {
                await new Promise((done) => setTimeout(done, 200));
            }
        }
    }
}

// A page, or a frame in a process of its own.
export class Session {
    constructor(browser, id) {
        Object.assign(this, { browser, id, frames: [], errors: [], requests: [], dialogs: 0 });
        browser.listeners.push((method, params, sessionId) => {
            if (sessionId === id) this.hear(method, params);
        });
    }
    send(method, params) {
        return this.browser.send(method, params, this.id);
    }
    async prepare() {
        await this.send("Runtime.enable");
        await this.send("Page.enable").catch(() => {});
        await this.send("Network.enable").catch(() => {});
        await this.send("Target.setAutoAttach", { autoAttach: true, waitForDebuggerOnStart: false, flatten: true });
    }
    hear(method, params) {
        if (method === "Target.attachedToTarget" && params.targetInfo.type === "iframe") {
            const frame = new Session(this.browser, params.sessionId);
            this.frames.push(frame);
            frame.prepare().catch(() => {});
        }
        if (method === "Target.detachedFromTarget")
            this.frames = this.frames.filter(({ id }) => id !== params.sessionId);
        if (method === "Runtime.exceptionThrown")
            this.errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
        if (method === "Network.requestWillBeSent") this.requests.push(params.request.url);
        if (method === "Page.javascriptDialogOpening") {
            ++this.dialogs;
            this.send("Page.handleJavaScriptDialog", { accept: true });
        }
    }
    // Returns the value of an expression, which may be a promise.
    async value(expression) {
        const { result, exceptionDetails } = await this.send("Runtime.evaluate",
            { expression, awaitPromise: true, returnByValue: true, userGesture: true });
        if (exceptionDetails)
            throw new Error(`${exceptionDetails.exception?.description ?? exceptionDetails.text}\n${expression}`);
        return result.value;
    }
    // Waits until an expression is true.
    async until(expression, seconds = 200) {
        for (const end = Date.now() + 1000 * seconds; Date.now() < end; ) {
            if (await this.value(expression).catch(() => false)) return;
            await new Promise((done) => setTimeout(done, 30));
        }
        throw new Error(`not within ${seconds} s: ${expression}`);
    }
    async open(url) {
        await this.send("Page.navigate", { url });
        await this.until("document.readyState === 'complete'");
    }
    mouse(type, x, y, extra = {}) {
        const held = type === "mouseMoved" ? extra.buttons ?? 0 : 1;
        return this.send("Input.dispatchMouseEvent",
            { type, x, y, button: "left", buttons: held, clickCount: type === "mouseMoved" ? 0 : 1, ...extra });
    }
    async click(selector) {
        const [x, y] = await this.value(`(() => { const node = document.querySelector(${JSON.stringify(selector)});
            node.scrollIntoView({ block: "nearest" });
            const box = node.getBoundingClientRect();
            return [box.left + box.width / 2, box.top + box.height / 2]; })()`);
        await this.mouse("mousePressed", x, y);
        await this.mouse("mouseReleased", x, y);
    }
    // Drops files of the disk at a place of the page, or of a frame, which forwards them. Until the page has answered
    // where the pointer is over it, Chromium does not know that the page takes files, and saves them instead: they are
    // then dropped again.
    async drop(files, x = 150, y = 300) {
        const data = { items: [], files, dragOperationsMask: 1 },
            send = (type) => this.send("Input.dispatchDragEvent", { type, x, y, data }),
            pause = () => new Promise((done) => setTimeout(done, 100));
        await this.value(`globalThis.drops = 0;
            if (!globalThis.counts_drops) {
                globalThis.counts_drops = true;
                document.addEventListener("drop", () => ++globalThis.drops, true);
                addEventListener("message", ({ data }) => { if (data?.harmorph === "files") ++globalThis.drops; });
            }`);
        for (let trial = 0; trial < 20; ++trial) {
            await send("dragEnter");
            for (let over = 0; over < 2; ++over) await send("dragOver").then(pause);
            await send("drop");
            await pause();
            if (await this.value("globalThis.drops") > 0) return;
        }
        throw new Error("the page takes no files");
    }
    async picture(file) {
        const { data } = await this.send("Page.captureScreenshot", { format: "png" });
        fs.writeFileSync(file, Buffer.from(data, "base64"));
    }
}
