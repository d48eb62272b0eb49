// SPDX-License-Identifier: GPL-3.0-or-later
// Studio as one page: its parts with the modules of this package.
import fs from 'node:fs';
import { deflateRawSync } from 'node:zlib';

const here = (name) => new URL(name, import.meta.url);
let page;

/** Bytes of the page. */
export function studioPage() {
    const module = (id, file) => () =>
        `<script id="${id}" type="text/plain">${deflateRawSync(fs.readFileSync(here(file)), { level: 9 }).toString('base64')}</script>\n`;
    page ??= Buffer.from(fs.readFileSync(here('./studio.html'), 'utf8').replace('{{solver}}', module('solver', './droplet_shape.wasm'))
        .replace('{{rain}}', module('rain-module', './droplet_rain.wasm'))
        .replace('{{liquid}}', module('liquid-module', './droplet_liquid.wasm')));
    return page;
}
