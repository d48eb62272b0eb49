// SPDX-License-Identifier: MIT
// Bundles Studio into one HTML file: node bundle_studio.mjs SOURCES OUTPUT.html [WASM RAIN_WASM LIQUID_WASM]
// SOURCES is this folder, WASM the solver, RAIN_WASM the rain, LIQUID_WASM 2D liquids; without them their slots stay, which the npm package fills. Run it in the folder of
// `npm ci` for src/html.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { bundleScript, bundleStyle, fill, moduleElement, policyOf, solverElement, threeLicence, withWorker } from '../html/bundling.mjs';

const [sources, output, wasm, rain, liquid] = process.argv.slice(2);
const script = await bundleScript(join(sources, 'alone.js'), await withWorker(sources));
const style = await bundleStyle([join(sources, '../html/page.css'), ...['studio.css', 'dew.css', '../live/live.css', '../liquid/liquid.css'].map((part) => join(sources, part))]);
writeFileSync(output, fill(readFileSync(join(sources, 'studio.html'), 'utf8'), {
    script, style, policy: policyOf(script, style, { compiles: true, works: true, plays: true }),
    solver: wasm ? solverElement(wasm) : '', rain: rain ? moduleElement('rain-module', rain) : '', liquid: liquid ? moduleElement('liquid-module', liquid) : '',
    three_licence: threeLicence(),
}, wasm ? [] : ['solver', 'rain', 'liquid']));
