// SPDX-License-Identifier: MIT
// Rain on a windshield over Studio: the page of `windshield --live`, which begins when it is opened.
import { openRain } from '../rain/rain.js';
import { unpackRain } from '../rain/unpack.js';

/** Whether the document holds the rain's module. */
export const hasRain = () => document.getElementById('rain-module') !== null;

/** Shows the rain until the user closes it. */
export async function showRain() {
    const { state, frames } = document.documentElement.dataset;
    const rain = await openRain(document.body, await unpackRain(), {}, () => {
        rain.close();
        Object.assign(document.documentElement.dataset, { state, frames });
    });
}
