"use strict";
// Files that the user opens, drops and saves.

const size_in_words = (bytes) => (bytes < 1e6 ? `${Math.ceil(bytes / 1e3)} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

// Saves a file. A Blob with a type that a browser shows would open instead.
function save_file(path, blob) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([blob], { type: "application/octet-stream" }));
    link.download = path.split("/").pop();
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

// Returns [path, File] of all files of a drop, also of those in folders, which not every browser gives to a page that
// was opened as a file.
async function dropped_files(transfer) {
    const found = [],
        items = [...transfer.items].filter(({ kind }) => kind === "file"),
        given = items.map((item) => ({ entry: item.webkitGetAsEntry?.() ?? null, file: item.getAsFile() }));
    const visit = async (entry, folder) => {
        if (entry.isFile) {
            const file = await new Promise((done, fail) => entry.file(done, fail));
            found.push([folder + entry.name, file]);
            return;
        }
        const reader = entry.createReader();
        for (;;) {
            const some = await new Promise((done, fail) => reader.readEntries(done, fail));
            if (some.length === 0) break;
            for (const inner of some) await visit(inner, `${folder}${entry.name}/`);
        }
    };
    for (const { entry, file } of given) {
        if (entry?.isDirectory) {
            await visit(entry, "").catch(() => {
                throw new Error("This browser does not give a dropped folder to a page: open the folder instead.");
            });
        } else if (file !== null) {
            found.push([file.name, file]);
        }
    }
    return found;
}

const listed_files = (list) => [...list].map((file) => [file.webkitRelativePath || file.name, file]);

const MOST = 2e9; // bytes of a file that is unpacked

// Returns the files, with those unpacked that gzip has compressed: the program in a browser reads no compressed files.
async function unpacked_files(files) {
    const unpack = async (file, path) => {
        let bytes = 0;
        const counter = new TransformStream({
            transform(part, controller) {
                bytes += part.length;
                if (bytes > MOST) throw new Error(`${path} unpacks to more than ${size_in_words(MOST)}.`);
                controller.enqueue(part);
            },
        });
        const stream = file.stream().pipeThrough(new DecompressionStream("gzip")).pipeThrough(counter);
        return new Response(stream).blob().catch((error) => {
            throw bytes > MOST ? error : new Error(`${path} is no file of gzip.`);
        });
    };
    return Promise.all(files.map(async ([path, file]) =>
        /\.gz$/i.test(path) ? [path.replace(/\.gz$/i, ""), await unpack(file, path)] : [path, file]));
}

// Returns the operand that stands for the mesh among some files: the file itself; of several, the case of OpenFOAM, the
// file that names pieces, or the one that does not stand beside a mesh.
function mesh_among(files) {
    const paths = files.map(([path]) => path),
        points = paths.find((path) => /(^|\/)polyMesh\/points$/.test(path));
    if (points !== undefined) return points.replace(/(\/?constant)?\/?polyMesh\/points$/, "") || ".";
    const beside = /\.(nmf|mapbc|curve|basis|txt|dat)$/i;
    return paths.find((path) => /\.pvtu$/i.test(path)) ?? paths.find((path) => !beside.test(path)) ?? paths[0];
}

// Returns a path that is no option.
const operand = (path) => (path.startsWith("-") ? `./${path}` : path);

// Returns a path that no file has yet.
function free_path(files, path) {
    const [, stem, end] = /^(.*?)((?:\.[^./]*)*)$/.exec(path);
    for (let number = 1; ; ++number) {
        const name = number === 1 ? path : `${stem}-${number}${end}`;
        if (!files.has(name)) return name;
    }
}
