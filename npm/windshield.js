// SPDX-License-Identifier: GPL-3.0-or-later
import { loadRain } from './rain.js';

const place = new URL('./droplet_rain.wasm', import.meta.url);

async function bytesOf() {
    // Node fetches no files; other systems have no node:fs, which bundlers must not look for.
    if (place.protocol === 'file:') {
        const files = 'node:fs/promises';
        const { readFile } = await import(/* @vite-ignore */ /* webpackIgnore: true */ files);
        return readFile(place);
    }
    const answer = await fetch(place);
    if (!answer.ok) {
        throw new Error(`${place} was not found`);
    }
    return answer.arrayBuffer();
}

let loaded;

/** Makes a dry windshield; see windshield.d.ts. */
export async function windshield(values) {
    loaded ??= bytesOf().then(loadRain);
    return (await loaded)(values);
}

export { halfFloat, loadRain } from './rain.js';
export { DropletError } from './droplet_error.js';
