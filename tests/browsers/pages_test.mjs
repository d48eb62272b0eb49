// SPDX-License-Identifier: GPL-3.0-or-later
// The pages of the command in Firefox or WebKit, whose engines are not that of the other tests: node --test pages_test.mjs
// BROWSER is firefox or webkit; STUDIO, RAIN and VIEWER are pages, of `studio`, of `windshield --live` and of `--html`;
// VALIDATOR is the script that checks glTF.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync, statSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { drawThrough } from './controls.mjs';

const { BROWSER, STUDIO, RAIN, VIEWER, VALIDATOR } = process.env;
const { begin } = await import(`./${BROWSER}.mjs`);
const kSize = { width: 1100, height: 640 };
const kWait = { timeout: 120_000 };  // enough on a busy machine, without a graphics card

const downloads = mkdtempSync(join(tmpdir(), `${BROWSER}-`));
let browser;
before(async () => { browser = await begin(downloads, kSize); });
after(async () => {
    await browser?.end?.();
    rmSync(downloads, { recursive: true });
});

/** Runs a test in a page, in which nothing may complain, and with nothing kept of other tests. */
function inBrowser(name, file, run) {
    test(`${BROWSER}: ${name}`, async () => {
        const { page, close } = await browser.open(resolve(file));
        let complaints;
        await run(page).finally(async () => { complaints = await close(); });
        assert.deepEqual(complaints, []);
    });
}

const until = (page, condition, ...values) => page.waitForFunction(condition, kWait, ...values);
const settled = (page) => until(page, () => document.documentElement.dataset.droplets === 'ready' && document.documentElement.dataset.state === 'resting');
const text = (page, selector) => page.$eval(selector, (element) => element.textContent);

async function frames(page, count) {
    const now = await page.evaluate(() => Number(document.documentElement.dataset.frames));
    await until(page, (last) => Number(document.documentElement.dataset.frames) >= last, now + count);
}

/** Mean level of a picture of the page, and the mean distance of its levels from that. */
async function levels(page, clip) {
    const png = await page.screenshot({ clip, encoding: 'base64' });
    return page.evaluate(async (base64) => {
        const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
        const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
        context.drawImage(image, 0, 0);
        const { data } = context.getImageData(0, 0, image.width, image.height);
        const mean = data.reduce((sum, level) => sum + level, 0) / data.length;
        return { mean, contrast: data.reduce((sum, level) => sum + Math.abs(level - mean), 0) / data.length };
    }, png);
}

const listed = () => readdirSync(downloads).filter((name) => !name.endsWith('.part'));

/** The file that is saved by an act; undefined if that ends with true, without one. */
async function fileOf(act, without = () => false) {
    const before = listed();
    await act();
    for (const end = performance.now() + kWait.timeout; performance.now() < end; await new Promise((done) => setTimeout(done, 100))) {
        const name = listed().find((one) => !before.includes(one));
        if (name && statSync(join(downloads, name)).size > 0) {
            return join(downloads, name);
        }
        if (await without()) {
            return undefined;
        }
    }
    return assert.fail(`${act} saves nothing`);
}

/** The file that a button of the menu saves. */
const saved = (page, button) => fileOf(async () => {
    await page.click('#save');
    await page.click(button);
});

inBrowser('a stroke becomes a droplet, and its file is valid', STUDIO, async (page) => {
    await settled(page);
    await drawThrough(page.mouse, await (await page.$('#sheet')).boundingBox(), [0.2, 0.5], [0.5, 0.4], [0.8, 0.5]);
    await until(page, () => /µL/.test(document.querySelector('#said').textContent));
    await settled(page);
    assert.match(await text(page, '#said'), /^[\d.]+\sµL of water, [\d.]+\sµm high$/);
    execFileSync('node', [VALIDATOR, await saved(page, '[data-save=glb]')], { stdio: 'pipe' });
    assert.match(readFileSync(await saved(page, '[data-save=project]'), 'utf8'), /^\{/);
});

inBrowser('the view shows a droplet of the gallery, and undo takes it away', STUDIO, async (page) => {
    await settled(page);
    await page.click('#gallery button:nth-of-type(3)');
    await settled(page);
    await until(page, () => /µL/.test(document.querySelector('#result').textContent));
    const { x, y, width, height } = await (await page.$('#view')).boundingBox();
    const middle = { x: x + 0.3 * width, y: y + 0.3 * height, width: 0.4 * width, height: 0.4 * height };
    const wet = await levels(page, middle);
    await page.keyboard.down('Control');
    await page.keyboard.press('z');
    await page.keyboard.up('Control');
    await settled(page);
    assert.equal(await text(page, '#result'), '');
    const dry = await levels(page, middle);
    assert.ok(Math.abs(wet.contrast - dry.contrast) + Math.abs(wet.mean - dry.mean) > 1, JSON.stringify({ wet, dry }));
});

inBrowser('dew covers an object', STUDIO, async (page) => {
    await settled(page);
    await page.click('#modes label:has([value=dew])');
    await page.click('#dew-bottle');
    await until(page, () => document.documentElement.dataset.dew === 'ready');
    assert.match(await text(page, '#result'), /^[\d.,]+.*droplets/);
});

inBrowser('Splash simulates and draws, and records a video or says that the browser cannot', STUDIO, async (page) => {
    await settled(page);
    await page.click('#liquid2d');
    await until(page, () => document.documentElement.dataset.state === 'running');
    await frames(page, 20);
    const { contrast } = await levels(page, { x: 20, y: 20, width: 700, height: 480 });
    assert.ok(contrast > 5, `${contrast}`);
    await page.click('#liquid2d-record');
    await frames(page, 20);
    const refused = async () => /recorded nothing/.test(await text(page, '.live .hint'));
    const video = await fileOf(() => page.click('#liquid2d-record'), refused);
    assert.ok(video ? readFileSync(video).subarray(0, 12).includes(video.endsWith('.mp4') ? 'ftyp' : '\x1AE') : BROWSER === 'webkit');
});

inBrowser('it rains in the page of windshield', RAIN, async (page) => {
    await until(page, () => document.documentElement.dataset.state === 'running');
    await frames(page, 30);
    const { contrast } = await levels(page, { x: 100, y: 100, width: 400, height: 300 });
    assert.ok(contrast > 1, `${contrast}`);
});

inBrowser('the page of --html shows its droplet', VIEWER, async (page) => {
    await until(page, () => document.documentElement.dataset.state === 'resting');
    const { contrast } = await levels(page, { x: 300, y: 120, width: 500, height: 400 });
    assert.ok(contrast > 1, `${contrast}`);
});
