// SPDX-License-Identifier: MIT
// What the page and Studio are bundled of. Run in the folder of `npm ci`.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { deflateRawSync } from 'node:zlib';

const here = process.cwd();
const esbuild = createRequire(join(here, 'package.json'))('esbuild');

export const threeLicence = () => readFileSync(join(here, 'node_modules/three/LICENSE'), 'utf8').trim();

/**
 * Bundles a script with everything that it imports.
 * @param given  more options for esbuild
 */
export async function bundleScript(entry, given = {}) {
    const bundle = await esbuild.build({
        entryPoints: [entry],
        absWorkingDir: here,
        nodePaths: [join(here, 'node_modules')],
        bundle: true,
        minify: true,
        format: 'iife',
        charset: 'ascii',
        legalComments: 'none',  // the page's top has three's whole licence
        logLevel: 'warning',
        target: ['es2022'],
        loader: { '.html': 'text', '.glsl': 'text', '.png': 'dataurl' },
        write: false,
        ...given,
    });
    return bundle.outputFiles[0].text.trim();
}

/** Options that put Studio's worker into a script. */
export const withWorker = async (studio) => ({ define: { WORKER: JSON.stringify(await bundleScript(join(studio, 'solver_worker.js'))) } });

/** Joins and shortens style sheets. */
export async function bundleStyle(files) {
    const css = files.map((file) => readFileSync(file, 'utf8')).join('\n');
    return (await esbuild.transform(css, { loader: 'css', minify: true, charset: 'ascii', target: ['es2022'] })).code.trim();
}

/** A module of WebAssembly as an element, for unpack.js. */
export const moduleElement = (id, wasm) =>
    `<script id="${id}" type="text/plain">${deflateRawSync(readFileSync(wasm), { level: 9 }).toString('base64')}</script>\n`;

/** The solver as an element. */
export const solverElement = (wasm) => moduleElement('solver', wasm);

/**
 * A policy that allows only exactly this script and style, and no network requests.
 * @param compiles  whether it has WebAssembly
 * @param works     whether workers run it
 * @param plays     whether it plays videos that the user gives
 */
export function policyOf(script, style, { compiles = false, works = false, plays = false } = {}) {
    for (const [name, text] of Object.entries({ script, style })) {
        if (/<\/(script|style)|<!--|[^\x09\x0a\x20-\x7e]/i.test(text)) {
            throw new Error(`the ${name} must be ASCII without HTML end tags or comments`);
        }
    }
    const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
    return [
        "default-src 'none'",
        `script-src ${hash(script)}${compiles ? " 'wasm-unsafe-eval'" : ''}`,
        ...works ? ['worker-src blob:'] : [],
        ...plays ? ['media-src blob:'] : [],
        `style-src ${hash(style)}`,
        'img-src data: blob:',
        "base-uri 'none'",
        "form-action 'none'",
    ].join('; ');
}

/** Fills the {{slots}} of a page, except those to be kept. */
export function fill(html, filled, kept = []) {
    return html.replace(/\{\{(\w+)\}\}/g, (slot, name) => (kept.includes(name) ? slot : filled[name] ?? (() => {
        throw new Error(`nothing for ${slot}`);
    })()));
}
