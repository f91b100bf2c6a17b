"use strict";
// Runs one command of the program on files in memory: in a worker of the workbench, and in node for tests.

const FOLDER = "/work"; // where the files are

// Takes what the program writes to standard error apart: the bar of progress, and lines of text.
class ErrorStream {
    constructor(report) {
        Object.assign(this, { report, bytes: [], lines: [] });
    }
    put(byte) {
        if (byte === 13 || byte === 10) this.end_line();
        else if (byte === 37) this.take_bar();
        else this.bytes.push(byte);
    }
    text() {
        const text = new TextDecoder().decode(Uint8Array.from(this.bytes));
        return text.replace(/\x1b\[K/g, "");
    }
    // The bar ends with a percent sign. Other such signs belong to a line.
    take_bar() {
        const [, what, percent] = /^(.+?) *\[[#.]*\] +(\d+) $/.exec(this.text()) ?? [];
        if (what === undefined) {
            this.bytes.push(37);
            return;
        }
        this.report(what, Number(percent) / 100);
        this.bytes = [];
    }
    end_line() {
        const text = this.text();
        if (text !== "") this.lines.push(text);
        this.bytes = [];
    }
}

function put_files(FS, files) {
    FS.mkdirTree(FOLDER);
    for (const [path, bytes] of files) {
        const folders = path.split("/").slice(0, -1).join("/");
        if (folders !== "") FS.mkdirTree(`${FOLDER}/${folders}`);
        FS.writeFile(`${FOLDER}/${path}`, bytes, { canOwn: true });
    }
    FS.chdir(FOLDER);
}

// Returns the files that a command has made or replaced, and their bytes.
function made_files(FS, given) {
    const made = [];
    const visit = (folder) => {
        for (const name of FS.readdir(`${FOLDER}/${folder}`)) {
            if (name === "." || name === "..") continue;
            const path = folder + name,
                { node } = FS.lookupPath(`${FOLDER}/${path}`);
            if (FS.isDir(node.mode)) visit(`${path}/`);
            else if (given.get(path) !== node)
                made.push([path, node.usedBytes > 0 ? node.contents.subarray(0, node.usedBytes) : new Uint8Array(0)]);
        }
    };
    visit("");
    return made;
}

// words: those of the command line. files: [path, Uint8Array] of all files that the command may read; the bytes belong
// to the command afterwards. report(what, fraction) is called on the way. Returns the exit code (-1: the program did
// not come to its end), what it said on standard output, the lines on standard error, and the files it has made.
async function run_command({ make_program, module, words, files, report }) {
    const said = [],
        error = new ErrorStream(report),
        nodes = new Map();
    let FS = null,
        code = -1;
    try {
        const program = await make_program({
            noInitialRun: true,
            quit(status, ended) {
                throw ended; // in node, too
            },
            instantiateWasm(imports, done) {
                WebAssembly.instantiate(module, imports).then(done);
                return {};
            },
            preRun: [
                (instance) => {
                    FS = instance.FS;
                    FS.init(() => null, (byte) => said.push(byte), (byte) => error.put(byte));
                },
            ],
        });
        FS.streams[1].tty = null;
        put_files(FS, files);
        for (const [path] of files) nodes.set(path, FS.lookupPath(`${FOLDER}/${path}`).node);
        code = program.callMain(words);
    } catch (fault) {
        error.end_line();
        error.lines.push(`the program stopped: ${fault.message ?? fault}`);
    }
    error.end_line();
    const text = new TextDecoder().decode(Uint8Array.from(said)),
        made = FS === null ? [] : made_files(FS, nodes);
    return { code: code ?? 0, said: text, lines: error.lines, made };
}

if (typeof exports === "object") exports.run_command = run_command;
