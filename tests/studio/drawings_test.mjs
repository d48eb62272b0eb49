// SPDX-License-Identifier: GPL-3.0-or-later
// Compares drawings in Studio, where the browser draws them, with those of the command: node --test drawings_test.mjs
// CHROMIUM is the browser, DROPLET_SHAPE the command.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';
import { fileOf, kDrawings } from './drawings.mjs';

const { CHROMIUM = '/usr/bin/chromium', DROPLET_SHAPE, SOURCES = resolve(import.meta.dirname, '../../src') } = process.env;
const { readPicture, withWiderStrokes } = await import(pathToFileURL(resolve(SOURCES, 'html/read_picture.js')).href);
const kSide = 512;  // a quarter of the side at which the command draws

let browser;
let page;
let folder;
before(async () => {
    folder = mkdtempSync(join(tmpdir(), 'drawings-'));
    browser = await chromium.launch({ executablePath: CHROMIUM, args: ['--headless=new', '--no-sandbox', '--disable-gpu'] });
    page = await browser.newPage();
});
after(async () => {
    await browser.close();
    rmSync(folder, { recursive: true });
});

/** A picture as the browser draws it, read as Studio reads it: kSide × kSide means of opacity, or of grey. */
const drawn = async (type, content) => Buffer.from(await page.evaluate(async ([source, type, base64, side]) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const read = eval(`${source}; readPicture`);
    const canvas = await read(new File([bytes], 'drawing', { type }), side);
    const { data, width } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    const factor = width / side;
    const channel = type === 'image/png' ? 0 : 3;
    const sums = new Float64Array(side * side);
    for (let i = 0; i < data.length / 4; ++i) {
        sums[Math.floor(i / width / factor) * side + Math.floor((i % width) / factor)] += data[4 * i + channel];
    }
    return btoa(sums.reduce((text, sum) => text + String.fromCharCode(Math.round(sum / factor ** 2)), ''));
}, [`${withWiderStrokes}; ${readPicture}`, type, content.toString('base64'), kSide]), 'base64');

/** The command's mask of a drawing, whose sides are larger than kSide by a whole factor. */
function drawnByCommand(path) {
    const mask = join(folder, 'mask.png');
    execFileSync(DROPLET_SHAPE, [path, join(folder, 'drop.stl'), '--mask-out', mask, '--model', 'linear', '--triangles', '200', '--quiet']);
    return drawn('image/png', readFileSync(mask));
}

test('there are thirty drawings', () => assert.equal(Object.keys(kDrawings).length, 30));
for (const name of Object.keys(kDrawings)) {
    test(`${name} is drawn alike`, async () => {
        const path = join(folder, 'drawing.svg');
        writeFileSync(path, fileOf(name));
        const command = await drawnByCommand(path);
        const browsers = await drawn('image/svg+xml', Buffer.from(fileOf(name)));
        const inked = browsers.reduce((sum, level) => sum + level / 255, 0);
        const apart = browsers.reduce((sum, level, i) => sum + (Math.abs(level - command[i]) > 128 ? 1 : 0), 0);
        assert.ok(inked > 100, `${inked} pixels of ink`);
        assert.ok(apart < 0.002 * inked, `${apart} of ${inked} pixels differ`);
    });
}
