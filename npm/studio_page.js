// SPDX-License-Identifier: GPL-3.0-or-later
// Studio as one page: its parts with the solver of this package.
import fs from 'node:fs';
import { deflateRawSync } from 'node:zlib';

const here = (name) => new URL(name, import.meta.url);
let page;

/** Bytes of the page. */
export function studioPage() {
    page ??= Buffer.from(fs.readFileSync(here('./studio.html'), 'utf8').replace('{{solver}}', () =>
        `<script id="solver" type="text/plain">${deflateRawSync(fs.readFileSync(here('./droplet_shape.wasm')), { level: 9 }).toString('base64')}</script>\n`));
    return page;
}
