// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `droplet-shape flow --html` in a real browser: node --test flow_test.mjs
// DROPLET_SHAPE is the command; for the rest see browser.mjs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { folder, jsonOf, watched } from './browser.mjs';

const { DROPLET_SHAPE } = process.env;
const kSide = 0.1;  // of the plate [m]
const kRate = 20;
const kFrames = 12;
const kBlue = [0.02, 0.05, 0.6];  // of the plate, which is drawn without red
const kWide = { width: 800, height: 400 };  // wide enough for the panel to be beside the view

/** Writes a plate that slopes 45° down to +z, and is blue. */
function writePlate(name) {
    const far = 1000 * kSide;
    writeFileSync(join(folder, `${name}.mtl`), `newmtl blue\nKd ${kBlue.join(' ')}\n`);
    writeFileSync(join(folder, `${name}.obj`), [`mtllib ${name}.mtl`, 'usemtl blue', 'v 0 0 0', `v ${far} 0 0`, `v ${far} ${far} ${-far}`,
        `v 0 ${far} ${-far}`, 'f 1 2 3', 'f 1 3 4', ''].join('\n'));
}

/** A page of droplets of 30 µL that start along the upper edge of the plate, and run. */
function write(name, ...words) {
    writePlate(name);
    const starts = [0.2, 0.5, 0.8].map((share) => `${share * kSide},${0.9 * kSide},${-0.9 * kSide},3e-8`);
    writeFileSync(join(folder, 'start.csv'), ['x_m,y_m,z_m,volume_m3', ...starts, ''].join('\n'));
    const page = join(folder, `${name}.html`);
    execFileSync(DROPLET_SHAPE, ['flow', join(folder, `${name}.obj`), join(folder, `${name}.glb`), '--start', join(folder, 'start.csv'),
        '--hysteresis', '0.02', '--pinning', '0', '--material', 'ink', '--time', `${kFrames / kRate}s`, '--fps', `${kRate}`, '--html', page, '-q', ...words]);
    return page;
}

const resting = (page) => page.waitForFunction(() => document.documentElement.dataset.state === 'resting');

async function showTime(page, seconds) {
    await page.locator('#time').evaluate((slider, to) => {
        slider.value = to;
        slider.dispatchEvent(new Event('input', { bubbles: true }));
    }, seconds);
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await resting(page);
}

/** Levels of all pixels beside the panel: red, green, blue, one after another. */
async function pixels(page) {
    const { width } = await page.locator('#view').boundingBox();
    const panel = await page.locator('#panel').boundingBox();
    const png = await page.screenshot({ clip: { x: 0, y: 0, width: Math.min(width, Math.floor(panel.x)), height: kWide.height } });
    return page.evaluate(async (base64) => {
        const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
        const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
        context.drawImage(image, 0, 0);
        return { width: image.width, levels: [...context.getImageData(0, 0, image.width, image.height).data].filter((_, k) => k % 4 < 3) };
    }, png.toString('base64'));
}

/** Pixels that differ from those of another picture: their number, and the mean of their rows. */
function changed({ width, levels }, from) {
    const rows = [];
    for (let i = 0; i < levels.length; i += 3) {
        if ([0, 1, 2].some((c) => Math.abs(levels[i + c] - from.levels[i + c]) > 8)) {
            rows.push(Math.floor(i / 3 / width));
        }
    }
    return { count: rows.length, row: rows.reduce((a, b) => a + b, 0) / Math.max(rows.length, 1) };
}

let pages;
before(() => {
    pages = { running: write('running'), spun: write('spun', '--spin', '90deg/s'), dry: write('dry', '--no-wetting', '--film', '0.05mm', '--drying', '150ms') };
});

/** Runs a test in a page of its own, in which nothing may complain and nothing may be fetched. */
function flow(name, which, run, options = {}) {
    test(name, async () => {
        const url = pathToFileURL(pages[which]).href;
        const { context, complaints } = await watched({ viewport: kWide, deviceScaleFactor: 0.5, colorScheme: 'light', reducedMotion: 'reduce', ...options }, url);
        const page = await context.newPage();
        await page.goto(url);
        await resting(page);
        await run(page);
        assert.deepEqual(complaints, []);
        await context.close();
    });
}

flow('droplets run down, and their streaks grow', 'running', async (page) => {
    const shown = [];
    for (const frame of [0, 4, 8, 11]) {
        await showTime(page, frame / kRate);
        shown.push(await pixels(page));
        assert.match(await page.locator('#moment').innerText(), new RegExp(`^${frame + 1} of ${kFrames}`));
    }
    const changes = shown.slice(1).map((picture) => changed(picture, shown[0]));
    // What has changed since the start is streaks above and droplets at their end.
    assert.ok(changes[0].count > 50 && changes[1].count > changes[0].count && changes[2].count > changes[1].count, JSON.stringify(changes));
    assert.ok(changes[0].row < changes[1].row && changes[1].row < changes[2].row, JSON.stringify(changes));
    // Back at the start there is nothing but the first frame.
    await showTime(page, 0);
    assert.equal(changed(await pixels(page), shown[0]).count, 0);
    assert.equal(await page.evaluate(() => document.documentElement.dataset.state), 'resting');
});

flow('every frame is drawn as the file says', 'running', async (page) => {
    // Between two frames droplets are between their places: the picture differs from both.
    const at = async (seconds) => {
        await showTime(page, seconds);
        return pixels(page);
    };
    const [before, between, after] = [await at(5 / kRate), await at(5.5 / kRate), await at(6 / kRate)];
    const ways = [changed(between, before), changed(between, after), changed(after, before)];
    assert.ok(ways.every(({ count }) => count > 0), JSON.stringify(ways));
    const text = await page.evaluate(() => document.getElementById('model').textContent);
    const json = jsonOf(Buffer.from(text, 'base64'));
    assert.ok(json.nodes.some(({ name }) => name?.startsWith('streaks of frames ')));
    assert.equal(await page.locator('#figures tr').count(), 12);
});

flow('the view turns, plays at a speed and stops', 'running', async (page) => {
    const first = await pixels(page);
    await page.mouse.move(150, 200);
    await page.mouse.down();
    await page.mouse.move(210, 190, { steps: 4 });
    await page.mouse.up();
    await resting(page);
    assert.ok(changed(await pixels(page), first).count > 250);
    await page.locator('#pace').selectOption('0.1');
    await page.locator('#play').click();
    await page.waitForFunction(() => Number(document.getElementById('time').value) > 0.05);
    await page.locator('#play').click();
    await resting(page);
    const stopped = await page.locator('#time').inputValue();
    const held = await pixels(page);
    await page.waitForTimeout(200);
    assert.equal(await page.locator('#time').inputValue(), stopped);
    assert.equal(changed(await pixels(page), held).count, 0);
});

flow('droplets ride on an object that moves', 'spun', async (page) => {
    const first = await pixels(page);
    await showTime(page, 11 / kRate);
    // The plate has turned by 50°: far more changes than what three droplets cover.
    assert.ok(changed(await pixels(page), first).count > 2000);
});

flow('films vanish when they are dry', 'dry', async (page) => {
    const upper = async () => {
        const { width, levels } = await pixels(page);
        return { width, levels: levels.slice(0, 3 * width * Math.floor(levels.length / 9 / width)) };
    };
    await showTime(page, 0.55);
    const dry = await upper();
    await showTime(page, 0.2);
    assert.ok(changed(await upper(), dry).count > 12);
});

flow('it fits a phone, where fingers turn it', 'running', async (page) => {
    assert.equal(await page.evaluate(() => Math.max(document.documentElement.scrollWidth, document.body.scrollWidth) - innerWidth), 0);
    const picture = async () => (await page.locator('#view').screenshot()).toString('base64');
    const first = await picture();
    const touch = await page.context().newCDPSession(page);
    const finger = (type, ...points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    await finger('touchStart', [150, 150]);
    for (let i = 1; i <= 4; ++i) {
        await finger('touchMove', [150 + 15 * i, 150]);
    }
    await finger('touchEnd');
    await resting(page);
    assert.notEqual(await picture(), first);
}, { viewport: { width: 390, height: 700 }, hasTouch: true, isMobile: true });
