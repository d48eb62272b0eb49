// SPDX-License-Identifier: MIT
// The solver in the document: WebAssembly in #solver, and the worker's script, which the bundle put in this script.
import { decodeBase64 } from '../html/model.js';

/* global WORKER */

export async function unpackSolver() {
    const packed = decodeBase64(document.getElementById('solver').textContent.trim());
    const bytes = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).arrayBuffer();
    return {
        wasm: await WebAssembly.compile(bytes),
        worker_url: URL.createObjectURL(new Blob([WORKER], { type: 'text/javascript' })),
    };
}
