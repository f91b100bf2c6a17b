"use strict";
// The program: what is packed in this file, and its commands, each in a worker of its own.

const element = (id) => document.getElementById(id);

// Returns what is packed in an element, as a response.
function unpacked(id) {
    const bytes = Uint8Array.from(atob(element(id).textContent), (character) => character.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")));
}

class Cancelled extends Error {}

// What a command said when it did not do its work; the text is the program's.
class Refused extends Error {
    constructor(result) {
        const lines = result.lines.filter((line) => !is_warning(line));
        super(lines.map(plain).join("\n") || "The program ended without a word.");
        this.result = result;
    }
}

const is_warning = (line) => /^harmorph: (warning|the same as): /.test(line);
const plain = (line) => line.replace(/^harmorph: (warning: )?/, "");

class Program {
    // report(what, fraction) is called while a command runs; fraction is -1 where none is known.
    constructor(report) {
        this.report = report;
        this.worker = null;
        this.commands = []; // those that ran, as words
        this.ready = this.load();
        this.ready.catch(() => {}); // each command reports that
    }
    async load() {
        if (typeof DecompressionStream === "undefined")
            throw new Error("The workbench needs a browser of 2023 or newer.");
        this.module = await WebAssembly.compile(await unpacked("program_wasm").arrayBuffer());
        const script = await unpacked("program_script").blob();
        this.url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
    }

    // Runs a command on files, a Map of paths and Blobs; what it makes is added to them. what: its name for the bar of
    // progress. Returns the result if the exit code is 0; otherwise throws an Error. A command that runs already is
    // ended.
    async run(what, words, files) {
        this.cancel();
        this.report(what, -1);
        await this.ready;
        try {
            const result = await this.in_worker(what, words, files);
            for (const [path, blob] of result.made) files.set(path, blob);
            if (result.code !== 0) throw new Refused(result);
            this.commands.push(words);
            return result;
        } finally {
            this.report("", -1);
        }
    }
    in_worker(what, words, files) {
        return new Promise((done, fail) => {
            const worker = (this.worker = new Worker(this.url));
            const end = (action, value) => {
                worker.terminate();
                if (this.worker === worker) this.worker = null;
                action(value);
            };
            this.stop = () => end(fail, new Cancelled("cancelled"));
            worker.onmessage = ({ data }) => {
                if (data.result) end(done, data.result);
                else if (data.error !== undefined) end(fail, new Error(data.error));
                else this.report(`${what}: ${data.what}`, data.fraction);
            };
            worker.onerror = (event) => end(fail, new Error(event.message || "The worker has stopped."));
            worker.postMessage({ module: this.module, words, files: [...files] });
        });
    }
    cancel() {
        if (this.worker !== null) this.stop();
    }
}

// Returns words as they are typed in a shell.
const for_shell = (word) => (/^[\w.,:@=/+-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`);
const typed = (words) => ["harmorph", ...words].map(for_shell);

// Returns the words of a line that a user has typed; words may stand in quotes.
const words_of = (line) => [...line.matchAll(/"([^"]*)"|'([^']*)'|(\S+)/g)].map(([, a, b, c]) => a ?? b ?? c);

// Returns a name as options take it.
const quoted = (name) => (/^[\w.+-]+$/.test(name) ? name : `"${name.replace(/["\\]/g, "\\$&")}"`);
