// SPDX-License-Identifier: GPL-3.0-or-later
// The view of the page of `windshield --live` beside the ray-traced view of the same state: node --test rain_traced_test.mjs
// RAIN is the page, whose module is used, DROPLET_SHAPE the command, SOURCES the folder src; for the rest see browser.mjs. With
// PICTURES, a folder, both pictures stay there.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { inflateRawSync } from 'node:zlib';
import { folder, watched } from './browser.mjs';

const { RAIN, DROPLET_SHAPE, SOURCES, PICTURES = folder } = process.env;
const kSite = 'http://rain.test/';
const kSize = { width: 1280, height: 720 };
const kSteps = 400;  // of a sixtieth of a second, as the picture of the simulator in docs/library.md
const kRainfall = 5;  // [mm/h]
const kSpeed = 15;  // [m/s]
const kEye = 0.5;  // [m] from the glass

const kPage = `<!doctype html><title>rain</title><canvas id="view" width="${kSize.width}" height="${kSize.height}"></canvas>`;

/** A file of the page: sources as modules, shaders as their texts. */
function answer(path) {
    if (path === '/') {
        return { body: kPage, contentType: 'text/html' };
    }
    if (path === '/rain.wasm') {
        const packed = readFileSync(RAIN, 'utf8').match(/<script id="rain-module" type="text\/plain">([^<]*)/)[1];
        return { body: inflateRawSync(Buffer.from(packed, 'base64')), contentType: 'application/wasm' };
    }
    if (path === '/behind.png') {
        return { body: readFileSync(join(folder, 'behind.png')), contentType: 'image/png' };
    }
    const text = readFileSync(join(SOURCES, '..', path), 'utf8');
    return { body: path.endsWith('.glsl') ? `export default ${JSON.stringify(text)};` : text, contentType: 'text/javascript' };
}

/** A picture of the command after these steps. */
function traced(name, rainfall, ...words) {
    const path = join(PICTURES, name);
    execFileSync(DROPLET_SHAPE, ['windshield', path, '--preset', 'figure-3.12', '--rain', `${rainfall}mm/h`, '--speed', `${kSpeed}m/s`, '--fps', '60',
        '--time', '1s', '--warm-up', `${kSteps / 60 - 59 / 60}s`, '--frame-size', `${kSize.width}x${kSize.height}`, '--quiet', ...words]);
    return levelsOf(path);
}

const levelsOf = (path) => execFileSync('ffmpeg', ['-v', 'error', '-i', path, '-f', 'rawvideo', '-pix_fmt', 'rgb24', '-'], { maxBuffer: 1 << 24 });
/** Correlation of what rain changes in two pictures: 1 if it is the same but for a factor. */
function correlation(a, dry_a, b, dry_b) {
    const sums = [0, 0, 0];
    a.forEach((level, k) => {
        const [x, y] = [level - dry_a[k], b[k] - dry_b[k]];
        [x * x, x * y, y * y].forEach((product, i) => { sums[i] += product; });
    });
    return sums[1] / Math.sqrt(sums[0] * sums[2]);
}

const difference = (a, b) => a.reduce((sum, level, k) => sum + Math.abs(level - b[k]), 0) / a.length;

/** In the page: rain on the glass as the view draws it, without a car, a lens and a film, as a PNG. */
async function drawn(page, rainfall) {
    const base64 = await page.evaluate(async ({ rain, speed, steps, distance }) => {
        const [{ View }, { loadRain }] = await Promise.all([import('/src/rain/view.js'), import('/npm/rain.js')]);
        const make = await loadRain(await (await fetch('/rain.wasm')).arrayBuffer());
        const windshield = make({ preset: 'figure-3.12', rain, speed, mapWidth: 2048 });
        for (let k = 0; k < steps; ++k) {
            windshield.advance(1 / 60);
        }
        const canvas = document.getElementById('view');
        const view = new View(canvas);
        view.setGlass(windshield);
        const behind = new Image();
        behind.src = '/behind.png';
        await behind.decode();
        view.setPicture(await createImageBitmap(behind));
        view.setWater(windshield.draw());
        view.setMist(windshield.mist());
        view.draw(windshield, {
            travelled: 0, time: 0, blur: 0, camera: { distance }, border: 0, exposure: 1, film: { glowing: 0, falloff: 0, graininess: 0 },
        });
        const picture = canvas.toDataURL('image/png').split(',')[1];
        windshield.free();
        return picture;
    }, { rain: rainfall / 3.6e6, speed: kSpeed, steps: kSteps, distance: kEye });
    return Buffer.from(base64, 'base64');
}

test('the page draws rain as rays do', async () => {
    // The evening road through dry glass is behind both.
    traced('behind.png', 0);
    if (PICTURES !== folder) {
        copyFileSync(join(PICTURES, 'behind.png'), join(folder, 'behind.png'));
    }
    const exact = traced('traced.png', kRainfall, '--background', join(folder, 'behind.png'));
    const dry = traced('dry.png', 0, '--background', join(folder, 'behind.png'));
    const { context, complaints } = await watched({ viewport: { width: 400, height: 300 } }, kSite);
    await context.route(`${kSite}**`, (route) => route.fulfill(answer(new URL(route.request().url()).pathname)));
    const page = await context.newPage();
    await page.goto(kSite);
    const levels = {};
    for (const [name, rainfall] of [['drawn', kRainfall], ['drawn_dry', 0]]) {
        writeFileSync(join(PICTURES, `${name}.png`), await drawn(page, rainfall));
        levels[name] = levelsOf(join(PICTURES, `${name}.png`));
        await page.reload();
    }
    const seen = {
        rain: difference(exact, levels.drawn), pane: difference(dry, levels.drawn_dry), without: difference(exact, levels.drawn_dry),
        alike: correlation(exact, dry, levels.drawn, levels.drawn_dry),
    };
    const text = `mean differences from the ray-traced view: ${seen.rain.toFixed(3)} levels of 255, of a dry pane ${seen.without.toFixed(3)}; ` +
        `without rain ${seen.pane.toFixed(3)}; correlation of the droplets ${seen.alike.toFixed(3)}`;
    console.log(text);
    // 0.11 levels, 2.51 of 3.07 levels and 0.61 were measured. Droplets elsewhere have a correlation of 0.01.
    assert.ok(seen.pane < 0.3, text);
    assert.ok(seen.rain < 0.9 * seen.without, text);
    assert.ok(seen.alike > 0.55, text);
    assert.deepEqual(complaints, []);
    await context.close();
});
