// SPDX-License-Identifier: MIT
// Rain on a windshield over Studio: the page of `windshield --live`, which begins when it is opened.
import { openRain } from '../rain/rain.js';
import { unpackRain } from '../rain/unpack.js';

// Studio takes the document's place, with this element.
const held = document.getElementById('rain-module');

/** Whether the document holds the rain's module. */
export const hasRain = () => held !== null;

/** Shows the rain until the user closes it. */
export async function showRain() {
    const { state, frames } = document.documentElement.dataset;
    const rain = await openRain(document.body, await unpackRain(held), {}, () => {
        rain.close();
        Object.assign(document.documentElement.dataset, { state, frames });
    });
}
