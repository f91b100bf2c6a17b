// Stands before the program that emscripten makes. Whether a stream is a terminal, node knows; emscripten takes all
// three standard streams for terminals.
Module.onRuntimeInitialized = () => {
    for (const stream of [0, 1, 2]) FS.streams[stream].tty = require("tty").isatty(stream);
};
