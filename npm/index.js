// SPDX-License-Identifier: GPL-3.0-or-later
import { loadSolver } from './droplet_shape.js';
import { bytesOf } from './module_bytes.js';

const solver = await loadSolver(await bytesOf(new URL('./droplet_shape.wasm', import.meta.url)));

/** Options of makeDroplet and shapeDroplet: the command's, with the texts and defaults of its help. */
export const options = solver.options;

/** Reads a mask as makeDroplet does, such as by the strokes of `seeds` on a photograph. */
export const readMask = (picture, given) => solver.readMask(picture, given);

/** Makes the droplet of a mask: its surface, its report, and its files. */
export const shapeDroplet = (mask, given) => solver.makeDroplet(mask, given);

/** Makes the droplet of a mask, as the bytes of a GLB. */
export function makeDroplet(mask, given) {
    const droplet = solver.makeDroplet(mask, given);
    try {
        return droplet.file('glb');
    } finally {
        droplet.free();
    }
}

/** Options of dew: those of `droplet-shape dew`. */
export const dewOptions = solver.dewOptions;

/** Covers an object with droplets that rest on it: their surface, the report, and files. */
export const dew = (object, given) => solver.dew(object, given);

export { loadSolver, DropletError } from './droplet_shape.js';
