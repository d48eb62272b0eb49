// SPDX-License-Identifier: GPL-3.0-or-later
// Draws in Studio and takes the pictures of docs/cli/studio.md: node studio.mjs CHROMIUM PLAYWRIGHT_FOLDER STUDIO_HTML DESKTOP_PNG
// PHONE_PNG DEW_PNG PHOTOGRAPH_PNG ONTO_PNG RAINDROPS_JPG CAN_GLB
import { pathToFileURL } from 'node:url';
import { choose, setValue, settle, stateOfDew } from '../../tests/studio/controls.mjs';

const [executablePath, playwright, studio, desktop, phone, dew, photograph, onto, raindrops, can] = process.argv.slice(2);
const { chromium } = await import(pathToFileURL(`${playwright}/index.mjs`));
const browser = await chromium.launch({
    executablePath,
    args: ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});

/** Opens Studio in a window of its own. */
async function opened(options) {
    const page = await browser.newPage({ reducedMotion: 'reduce', ...options });
    page.setDefaultTimeout(120_000);
    page.on('pageerror', (error) => { throw error; });
    await page.goto(pathToFileURL(studio).href);
    await page.waitForFunction(() => document.documentElement.dataset.solver === 'ready');
    return page;
}

/** Points of a curve, for t from 0 to 1. */
const curve = (count, at) => Array.from({ length: count + 1 }, (_, k) => at(k / count));

/** Moves a pen through points, as parts of a sheet's sides, and takes it away; no cursor stays on the sheet. */
async function stroke(page, points, sheet = '#sheet') {
    const box = await page.locator(sheet).boundingBox();
    const pen = await page.context().newCDPSession(page);
    const touch = (type, ...at) => pen.send('Input.dispatchTouchEvent',
        { type, touchPoints: at.map(([x, y]) => ({ x: box.x + x * box.width, y: box.y + y * box.height })) });
    await touch('touchStart', points[0]);
    for (const point of points.slice(1)) {
        await touch('touchMove', point);
    }
    await touch('touchEnd');
}

/** Takes the picture when the whole meshes are shown and nothing moves. */
async function take(page, path) {
    await settle(page);
    await page.screenshot({ path });
    await page.close();
}

// A flower: petals of ink around a drop of honey.
const flower = await opened({ viewport: { width: 1280, height: 760 }, colorScheme: 'light', hasTouch: true });
await flower.locator('#name').fill('Flower');
await setValue(flower, 'liquid-material', 'ink');
await choose(flower, 'lasso');
await stroke(flower, curve(240, (t) => {
    const angle = 2 * Math.PI * t;
    const radius = 0.32 + 0.115 * Math.cos(6 * angle);
    return [0.5 + radius * Math.sin(angle), 0.5 - radius * Math.cos(angle)];
}));
await choose(flower, 'ellipse');
await flower.locator('#subtract').check();
await stroke(flower, [[0.36, 0.36], [0.64, 0.64]]);
await flower.locator('#subtract').uncheck();
await flower.locator('#layer-add').click();
await setValue(flower, 'liquid-liquid', 'honey');
await stroke(flower, [[0.385, 0.385], [0.615, 0.615]]);
await choose(flower, 'brush');
await take(flower, desktop);

// Handwriting in water.
const loops = await opened({ viewport: { width: 390, height: 760 }, deviceScaleFactor: 1.5, colorScheme: 'dark', hasTouch: true, isMobile: true });
await setValue(loops, 'size', 78);
await stroke(loops, curve(160, (t) => {
    const angle = 2 * Math.PI * 2.5 * t;
    return [0.19 + 0.62 * t - 0.12 * Math.sin(angle), 0.5 + 0.26 * Math.cos(angle)];
}));
await take(loops, phone);

// Drops on a leaf.
const leaf = await opened({ viewport: { width: 1000, height: 700 }, colorScheme: 'light', hasTouch: true });
await leaf.locator('#file').setInputFiles(raindrops);
await leaf.locator('#marks').waitFor();
for (const [x, y] of [[0.18, 0.32], [0.565, 0.35], [0.785, 0.54], [0.675, 0.545], [0.537, 0.555], [0.574, 0.47], [0.25, 0.89], [0.605, 0.9]]) {
    await stroke(leaf, [[x, y], [x + 0.004, y]], '#mark-sheet');
}
await leaf.locator('#marks [value=dry]').check({ force: true });
for (const line of [[[0.03, 0.22], [0.37, 0.2], [0.37, 0.64], [0.04, 0.79]], [[0.28, 0.4], [0.77, 0.4], [0.93, 0.22]], [[0.07, 0.4], [0.28, 0.4], [0.28, 0.24]],
    [[0.44, 0.74], [0.96, 0.63]], [[0.42, 0.52], [0.46, 0.63], [0.74, 0.62]], [[0.42, 0.95], [0.45, 0.81], [0.77, 0.8], [0.71, 0.96]],
    [[0.13, 0.95], [0.13, 0.82], [0.39, 0.82]], [[0.615, 0.45], [0.615, 0.58]], [[0.73, 0.48], [0.73, 0.6]], [[0.5, 0.28], [0.66, 0.28], [0.66, 0.42]]]) {
    await stroke(leaf, line, '#mark-sheet');
}
await leaf.waitForFunction(() => !document.getElementById('take').disabled);
await leaf.screenshot({ path: photograph });
await leaf.close();

// Letters of milk on a can.
const letters = await opened({ viewport: { width: 1280, height: 760 }, colorScheme: 'light', hasTouch: true });
await letters.locator('#lay-file').setInputFiles(can);
await letters.locator('#laid').waitFor();
await setValue(letters, 'liquid-material', 'milk');
await choose(letters, 'text');
await letters.locator('#text').fill('Aqua');
await setValue(letters, 'text-size', 150);
await stroke(letters, [[0.55, 0.29]]);
await choose(letters, 'brush');
await settle(letters);
await letters.locator('#view').focus();
for (const key of ['ArrowRight', 'ArrowRight', '+', '+']) {
    await letters.keyboard.press(key);
}
await letters.locator('#view').blur();
await take(letters, onto);

// A cold bottle.
const bottle = await opened({ viewport: { width: 1280, height: 760 }, colorScheme: 'light' });
await bottle.locator('#modes [value=dew]').check({ force: true });
await stateOfDew(bottle, 'empty');
await bottle.locator('#dew-bottle').click();
await stateOfDew(bottle, 'ready');
await bottle.locator('#view').focus();
for (const key of ['ArrowUp', '+', '+']) {
    await bottle.keyboard.press(key);
}
await bottle.locator('#view').blur();
await bottle.waitForFunction(() => document.documentElement.dataset.state === 'resting');
await bottle.screenshot({ path: dew });
await bottle.close();
await browser.close();
