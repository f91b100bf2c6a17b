#!/usr/bin/env node
// npx harmorph: the program, which computes with one thread and the baseline kernel.
"use strict";
const fs = require("fs"), path = require("path");

if (!fs.existsSync(path.join(__dirname, "program.cjs"))) {
    console.error("harmorph: this package was made without emscripten and has no program; the library is there");
    process.exit(1);
}
require("./program.cjs");
