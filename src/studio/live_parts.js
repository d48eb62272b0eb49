// SPDX-License-Identifier: MIT
// Simulations over Studio: rain on a windshield, which is the page of `windshield --live`, and 2D liquids. Each has a module
// in the document and begins when it is opened.
import { openLiquid } from '../liquid/liquid.js';
import { unpackModule } from '../live/unpack.js';
import { openRain } from '../rain/rain.js';

// Studio takes the document's place, with these elements.
const kHeld = { rain: document.getElementById('rain-module'), liquid2d: document.getElementById('liquid-module') };
const kOpen = { rain: openRain, liquid2d: openLiquid };

/** Names of the parts whose modules the document holds. */
export const kLiveParts = Object.keys(kHeld).filter((name) => kHeld[name] !== null);

/**
 * Shows a part until the user closes it.
 * @param name   of kLiveParts
 * @param given  of the part
 */
export async function showLive(name, given = {}) {
    const { state, frames } = document.documentElement.dataset;
    const part = await kOpen[name](document.body, await unpackModule(kHeld[name]), given, () => {
        part.close();
        Object.assign(document.documentElement.dataset, { state, frames });
    });
}
