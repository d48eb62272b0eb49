// SPDX-License-Identifier: GPL-3.0-or-later
// The part Splash of Studio in a real browser: node --test splash_test.mjs
// For the environment see browser.mjs.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { folder, jsonOf, kDesktop, kPhone, saved, studio } from './browser.mjs';
import { setValue, settle } from './controls.mjs';

const state = (page, name) => page.evaluate((key) => document.documentElement.dataset[key], name);
const particles = async (page) => Number(await state(page, 'particles'));

async function frames(page, count) {
    const now = Number(await state(page, 'frames'));
    await page.waitForFunction((until) => Number(document.documentElement.dataset.frames) >= until, now + count);
}

/** Opens the part in a scene, with fewer particles, since the processor is shared. */
async function open(page, scene, count = 3000) {
    await page.locator('#liquid2d').click();
    await page.waitForFunction(() => document.documentElement.dataset.state === 'running');
    await setValue(page, 'liquid2d-particles', count);
    await page.locator(`#liquid2d-preset-${scene}`).evaluate((button) => button.click());
    await page.waitForTimeout(400);  // the slider's change begins again
    await frames(page, 2);
}

/** Number of pixels of the comic look's water and droplets, beside the panel. */
async function blue(page) {
    const png = await page.screenshot({ clip: { x: 0, y: 0, width: 760, height: 540 } });
    return page.evaluate(async (base64) => {
        const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
        const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
        context.drawImage(image, 0, 0);
        const { data } = context.getImageData(0, 0, image.width, image.height);
        let count = 0;
        for (let k = 0; k < data.length; k += 4) {
            count += [[66, 152, 214], [104, 178, 228]].some((colour) => colour.every((level, channel) => Math.abs(data[k + channel] - level) < 12));
        }
        return count;
    }, png.toString('base64'));
}

studio('Splash begins with ten thousand particles', kDesktop, async (page) => {
    await page.locator('#liquid2d').click();
    await page.waitForFunction(() => document.documentElement.dataset.busy !== undefined);
    const count = await particles(page);
    assert.ok(Math.abs(count / 10000 - 1) < 0.05, `${count}`);
    console.log(`${count} particles: simulation and outlines ${await state(page, 'busy')} ms a frame`);
    await page.keyboard.press(' ');
    await page.waitForFunction(() => document.documentElement.dataset.state === 'paused');
    // The canvas fades in, and what is drawn is seen a frame later.
    await page.waitForFunction(() => getComputedStyle(document.querySelector('.liquid2d canvas')).opacity === '1');
    await frames(page, 2);
    const clip = { x: 20, y: 20, width: 700, height: 480 };  // without the fading hint
    const held = await page.screenshot({ clip });
    await page.waitForTimeout(300);
    assert.ok(held.equals(await page.screenshot({ clip })));
});

studio('a stroke pours, a click drops, a scene begins again', kDesktop, async (page) => {
    await open(page, 'basin');
    assert.deepEqual([await particles(page), await blue(page)], [0, 0]);
    await page.mouse.move(300, 200);
    await page.mouse.down();
    await page.mouse.move(420, 220, { steps: 6 });
    await frames(page, 20);
    await page.mouse.up();
    await frames(page, 1);
    const poured = await particles(page);
    assert.ok(poured > 60, `${poured}`);
    await frames(page, 12);
    const [held, seen] = [await particles(page), await blue(page)];
    assert.ok(held === poured && seen > 100, `${[held, seen]}`);
    await page.keyboard.press('2');
    await page.mouse.click(200, 150);
    await frames(page, 2);
    const dropped = await particles(page);
    assert.ok(dropped > poured + 60, `${[poured, dropped]}`);
    await page.keyboard.press('b');
    await frames(page, 2);
    assert.equal(await particles(page), 0);
});

studio('a stirrer moves the liquid', kDesktop, async (page) => {
    await open(page, 'splash');
    await setValue(page, 'liquid2d-gravity', 0);
    await frames(page, 10);
    const calm = Number(await state(page, 'speed'));
    await page.keyboard.press('3');
    await page.mouse.move(120, 410);
    await page.mouse.down();
    for (const x of [300, 480, 660]) {
        await page.mouse.move(x, 410, { steps: 3 });
        await frames(page, 1);
    }
    await page.mouse.up();
    await frames(page, 1);
    const stirred = Number(await state(page, 'speed'));
    assert.ok(stirred > 1.5 * calm, `${[calm, stirred]}`);
});

studio('a frame is saved as SVG, PNG and WebM', kDesktop, async (page) => {
    await open(page, 'dam');
    await frames(page, 10);
    const save = async (key) => {
        const [file] = await Promise.all([page.waitForEvent('download'), page.keyboard.press(key)]);
        await file.saveAs(join(folder, file.suggestedFilename()));
        return { name: file.suggestedFilename(), bytes: readFileSync(join(folder, file.suggestedFilename())) };
    };
    const svg = await save('v');
    assert.equal(svg.name, 'splash.svg');
    assert.match(svg.bytes.toString(), /<g id="liquid"><path [^>]*fill="#4298d6"[^>]* d="M[^"]{100,}/);
    assert.match(svg.bytes.toString(), /<g id="walls"><path/);
    assert.deepEqual([...(await save('s')).bytes.subarray(1, 4)], [...Buffer.from('PNG')]);
    await page.keyboard.press('r');
    await frames(page, 12);
    assert.deepEqual([...(await save('r')).bytes.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3]);
});

studio('a recording is saved as Lottie', kDesktop, async (page) => {
    await open(page, 'dam');
    const lottie = async (act) => {
        const [file] = await Promise.all([page.waitForEvent('download'), act()]);
        assert.equal(file.suggestedFilename(), 'splash.json');
        await file.saveAs(join(folder, 'splash.json'));
        return JSON.parse(readFileSync(join(folder, 'splash.json')));
    };
    await page.locator('#liquid2d-record-lottie').evaluate((button) => button.click());
    await page.keyboard.press('r');
    await frames(page, 12);
    const made = await lottie(() => page.keyboard.press('r'));
    assert.deepEqual([made.fr, made.w, made.h], [24, 1280, 720]);
    assert.ok(made.op >= 4 && made.op <= 14, `${made.op}`);
    assert.deepEqual(made.layers.map(({ nm }) => nm).filter((name) => ['walls', 'liquid', 'background'].includes(name)), ['walls', 'liquid', 'background']);
    // A new beginning ends it.
    await page.keyboard.press('r');
    await frames(page, 3);
    assert.ok((await lottie(() => page.keyboard.press('b'))).op >= 1);
    assert.equal(await page.locator('#liquid2d-record.recording').count(), 0);
});

studio('made 3D, the liquid is on the sheet and a droplet stands beside it', kDesktop, async (page) => {
    await open(page, 'dam');
    await frames(page, 12);
    await page.keyboard.press('m');
    await page.waitForFunction(() => document.querySelector('.liquid2d') === null);
    const drawn = await page.evaluate(() => {
        const sheet = document.getElementById('sheet');
        const { data } = sheet.getContext('2d').getImageData(0, 0, sheet.width, sheet.height);
        return { width: sheet.width, height: sheet.height, share: data.filter((alpha, k) => k % 4 === 3 && alpha > 127).length / (sheet.width * sheet.height) };
    });
    // The column of the dam has 0.72 of the window's 5.76 m², wherever it flows.
    assert.deepEqual([drawn.width, drawn.height], [1024, 576]);
    assert.ok(Math.abs(drawn.share / 0.125 - 1) < 0.1, `${drawn.share}`);
    await settle(page);
    const { name, bytes } = await saved(page, '[data-save=glb]');
    assert.equal(name, 'Dam.glb');
    assert.ok(jsonOf(bytes).meshes.length > 0);
    await page.locator('#undo').click();
    await page.locator('#liquid2d').click();
    await page.waitForFunction(() => document.documentElement.dataset.state === 'running');
});

studio('on a phone the bar is reachable and the panel closed at first', kPhone, async (page) => {
    assert.equal(await page.evaluate(() => innerWidth), 390);  // the bar of Studio fits, too
    await page.locator('#liquid2d').click();
    await page.waitForFunction(() => document.documentElement.dataset.state === 'running');
    for (const button of await page.locator('.liquid2d .bar button').all()) {
        const { x, width } = await button.boundingBox();
        assert.ok(x >= 0 && x + width <= 390 && width > 25, `${x} + ${width}`);
    }
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    assert.equal(await page.locator('#liquid2d-settings').isVisible(), false);
});
