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

    /** Puts an answer where host.h has a DropletPage. */
    function put(answer, place) {
        const view = new DataView(memory().buffer);
        for (const [k, number] of [answer.width, answer.height, answer.physicalWidth].entries()) {
            view.setFloat64(place + 8 * k, number ?? 0, true);
        }
        view.setInt32(place + 24, Number(answer.is_damaged ?? false), true);
        for (const [k, line] of [answer.problem ?? '', answer.lacking ?? ''].entries()) {
            const bytes = new Uint8Array(memory().buffer, place + 28 + 1000 * k, 1000).fill(0);
            bytes.set(new TextEncoder().encode(line).subarray(0, 999));
        }
    }
    const late = () => ({ problem: `takes more than ${seconds} s to draw` });

    return {
        open_svg(text, size, limit, place) {
            seconds = limit;
            put(ask({ text: new Uint8Array(memory().buffer, text, size).slice() }) ?? late(), place);
        },
        draw_svg(width, height, pixels, place) {
            const answer = ask({ width, height }) ?? late();
            put(answer, place);
            if (answer.pixels) {
                new Uint8Array(memory().buffer, pixels, 4 * width * height).set(answer.pixels);
            }
        },
    };
}
