"use strict";
// A worker runs one command and is ended afterwards, so that all its memory is free again.

const read_file = (blob) => new Uint8Array(new FileReaderSync().readAsArrayBuffer(blob));

// A rejected promise is no error that the page would hear of.
async function answer({ module, words, files }) {
    const result = await run_command({
        make_program,
        module,
        words,
        files: files.map(([path, blob]) => [path, read_file(blob)]),
        report: (what, fraction) => postMessage({ what, fraction }),
    });
    result.made = result.made.map(([path, bytes]) => [path, new Blob([bytes])]);
    postMessage({ result });
}
onmessage = ({ data }) => {
    answer(data).catch((error) => postMessage({ error: error.message }));
};
