// SPDX-License-Identifier: GPL-3.0-or-later
import { bytesOf } from './module_bytes.js';
import { loadRain } from './rain.js';

let loaded;

/** Makes a dry windshield; see windshield.d.ts. */
export async function windshield(values) {
    loaded ??= bytesOf(new URL('./droplet_rain.wasm', import.meta.url)).then(loadRain);
    return (await loaded)(values);
}

export { halfFloat, loadRain } from './rain.js';
export { DropletError } from './droplet_error.js';
