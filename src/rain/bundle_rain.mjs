// SPDX-License-Identifier: MIT
// Bundles the rain into one HTML file: node bundle_rain.mjs SOURCES OUTPUT.html WASM
// SOURCES is this folder, WASM droplet_rain.wasm. The slot of its values stays, which the command fills. Run it in the folder
// of `npm ci` for src/html.
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { bundleScript, bundleStyle, fill, moduleElement, policyOf } from '../html/bundling.mjs';

const [sources, output, wasm] = process.argv.slice(2);
const script = await bundleScript(join(sources, 'alone.js'));
const style = await bundleStyle([join(sources, '../live/live.css')]);
writeFileSync(output, fill(readFileSync(join(sources, 'rain.html'), 'utf8'), {
    script, style, policy: policyOf(script, style, { compiles: true, plays: true }), module: moduleElement('rain-module', wasm),
}, ['values']));
