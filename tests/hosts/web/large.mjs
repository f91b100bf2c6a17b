// usage: node large.mjs PACKAGE MODULE   What 32 bits cannot address is refused with the bytes that are needed; a
// worker with a module that was compiled once. Throws if something is wrong.
import assert from "node:assert";
import fs from "node:fs";
import { isMainThread, parentPort, Worker, workerData } from "node:worker_threads";

const { load, HarmorphError } = await import(isMainThread ? process.argv[2] : workerData.name);

if (isMainThread) {
    const hm = await load(), n = 3000;
    const ring = (j) => Int32Array.from({ length: n }, (_, i) => i + n * j);
    const side = (i) => Int32Array.from({ length: n }, (_, j) => i + n * j);
    const mesh = new hm.Mesh(new Float64Array(2 * n * n), { ni: n, nj: n },
        { wall: ring(0), far: ring(n - 1), left: side(0), right: side(n - 1) });
    assert.throws(() => new hm.Morph(mesh, null, { wall: "given" }), (error) => {
        assert(error instanceof HarmorphError && error.code === "HM_BAD_ARGUMENT", error.stack);
        assert(error.value > 2 ** 31 && error.value < 1000 * n * n, `${error.value}`);
        assert(error.message.includes("bytes"), error.message);
        return true;
    });
    mesh.free();
    const module = new WebAssembly.Module(fs.readFileSync(process.argv[3]));
    const worker = new Worker(new URL(import.meta.url), { workerData: { name: process.argv[2], module } });
    const answer = await new Promise((resolve, reject) => worker.once("message", resolve).once("error", reject));
    assert.deepStrictEqual(answer, { kernel: "given", quads: 4 });
} else {
    const hm = await load({ module: workerData.module });
    const xy = Float64Array.from({ length: 18 }, (_, k) => (k % 2 === 0 ? (k >> 1) % 3 : Math.floor((k >> 1) / 3)));
    const mesh = new hm.Mesh(xy, { ni: 3, nj: 3 }, { all: [0, 1, 2, 5, 8, 7, 6, 3, 0] });
    parentPort.postMessage({ kernel: hm.kernel, quads: mesh.report().quads });
    mesh.free();
}
