// SPDX-License-Identifier: GPL-3.0-or-later
// The thread that has resvg: it opens an SVG, and draws it in the width that is asked for.
import fs from 'node:fs';
import { createRequire } from 'node:module';
import { workerData } from 'node:worker_threads';
import { fontsFor } from './fonts.js';
import { decoded, lackingIn, withFontParts, withPage } from './svg_text.js';

const { port, answers } = workerData;
let Resvg;
let text;
let font;

function opened(bytes) {
    text = withFontParts(decoded(bytes));
    const fonts = fontsFor(text);
    font = { fontBuffers: fonts.buffers, ...fonts.names };
    const page = withPage(text, () => {
        const unsized = new Resvg(text, { font });
        const bounds = unsized.getBBox();
        unsized.free();
        return bounds;
    });
    text = page.text;
    const sized = new Resvg(text, { font });
    const { width, height } = sized;
    sized.free();
    return { width, height, ...page, text: undefined, lacking: [...lackingIn(text), ...fonts.lacking].join(', ') };
}

/** Pixels of rows that are as many as wanted: the last one may be missing, or one too many. */
function drawn(width, height) {
    const page = new Resvg(text, { font, fitTo: { mode: 'width', value: width } });
    const image = page.render();
    const pixels = new Uint8Array(4 * width * height);
    pixels.set(image.pixels.subarray(0, pixels.length));
    image.free();
    page.free();
    return { pixels };
}

/** Loads resvg here, where a failure becomes an answer. */
async function load() {
    const resvg = await import('@resvg/resvg-wasm').catch((error) => {
        throw error.code === 'ERR_MODULE_NOT_FOUND' ? new Error('cannot be drawn: the npm package @resvg/resvg-wasm is not installed') : error;
    });
    await resvg.initWasm(fs.readFileSync(createRequire(import.meta.url).resolve('@resvg/resvg-wasm/index_bg.wasm')));
    Resvg = resvg.Resvg;
}

const ready = load();
ready.catch(() => {});  // the first question tells it
port.on('message', async (question) => {
    let answer;
    try {
        await ready;
        if (question.text) {
            answer = opened(question.text);
        } else {
            answer = drawn(question.width, question.height);
        }
    } catch (error) {
        answer = { is_damaged: Resvg !== undefined, problem: String(error?.message ?? error) };
    }
    port.postMessage(answer);
    Atomics.add(answers, 0, 1);
    Atomics.notify(answers, 0);
});
