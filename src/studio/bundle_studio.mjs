// SPDX-License-Identifier: MIT
// Bundles Studio into one HTML file: node bundle_studio.mjs SOURCES OUTPUT.html [WASM]
// SOURCES is this folder, WASM the solver; without it its slot stays, which the npm package fills. Run it in the folder of
// `npm ci` for src/html.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { bundleScript, bundleStyle, fill, policyOf, solverElement, threeLicence, withWorker } from '../html/bundling.mjs';

const [sources, output, wasm] = process.argv.slice(2);
const script = await bundleScript(join(sources, 'alone.js'), await withWorker(sources));
const style = await bundleStyle([join(sources, '../html/page.css'), join(sources, 'studio.css'), join(sources, 'dew.css')]);
writeFileSync(output, fill(readFileSync(join(sources, 'studio.html'), 'utf8'), {
    script, style, policy: policyOf(script, style, { compiles: true, works: true }), solver: wasm ? solverElement(wasm) : '', three_licence: threeLicence(),
}, wasm ? [] : ['solver']));
