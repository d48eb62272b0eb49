// SPDX-License-Identifier: GPL-3.0-or-later
// Draws SVG for the module, which waits: another thread has resvg, and is stopped if a drawing takes too long.
import { MessageChannel, receiveMessageOnPort, Worker } from 'node:worker_threads';

const kLoading = 20;  // seconds for the thread and for resvg to start

/**
 * Imports of the module that draw.
 * @param {() => WebAssembly.Memory} memory
 */
export function svgDrawer(memory) {
    let thread;
    let seconds = 0;

    function start() {
        const answers = new Int32Array(new SharedArrayBuffer(4));
        const { port1, port2 } = new MessageChannel();
        const worker = new Worker(new URL('./svg_worker.js', import.meta.url), { workerData: { port: port2, answers }, transferList: [port2] });
        worker.unref();
        return { answers, port: port1, worker, limit: kLoading };
    }

    /** What the thread answers; nothing if it takes too long. */
    function ask(question) {
        thread ??= start();
        const { answers, port, worker } = thread;
        const before = Atomics.load(answers, 0);
        port.postMessage(question);
        const limit = 1e3 * (seconds + thread.limit);
        thread.limit = 0;
        if (Atomics.wait(answers, 0, before, limit) === 'timed-out') {
            worker.terminate();
            thread = undefined;
            return undefined;
        }
        return receiveMessageOnPort(port).message;
    }

    return {
        open_svg(text, size, limit, place) {
            seconds = limit;
            const answer = ask({ text: new Uint8Array(memory().buffer, text, size).slice() })
                ?? { problem: `takes more than ${limit} s to draw` };
            const view = new DataView(memory().buffer);
            view.setFloat64(place, answer.width ?? 0, true);
            view.setFloat64(place + 8, answer.height ?? 0, true);
            view.setInt32(place + 16, Number(answer.is_damaged ?? false), true);
            for (const [k, line] of [answer.problem ?? '', answer.lacking ?? ''].entries()) {
                const bytes = new Uint8Array(memory().buffer, place + 20 + 1000 * k, 1000).fill(0);
                bytes.set(new TextEncoder().encode(line).subarray(0, 999));
            }
        },
        draw_svg(width, height, place) {
            const answer = ask({ width, height });
            if (answer?.pixels) {
                new Uint8Array(memory().buffer, place, 4 * width * height).set(answer.pixels);
            }
            return Number(answer?.pixels !== undefined);
        },
    };
}
