// SPDX-License-Identifier: GPL-3.0-or-later
// The widget for notebooks in a real browser, with a model as anywidget gives it. WIDGET is its script, DROPLET_SHAPE the program.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { folder, watched } from './browser.mjs';

const { DROPLET_SHAPE, SOURCES, WIDGET } = process.env;
const glbs = ['ring.svg', 'ampersand.png'].map((mask) => {
    const path = join(folder, `${mask}.glb`);
    execFileSync(DROPLET_SHAPE, [join(SOURCES, '../data', mask), path, '--triangles', '2k', '--fill-range', '0..2', '--quiet']);
    return readFileSync(path).toString('base64');
});
const notebook = join(folder, 'notebook.html');
writeFileSync(notebook, '<!doctype html><meta charset="utf-8"><title>notebook</title><div id="cell" style="width: 400px"></div>');

/** Runs a test with the widget in a notebook. `page.shown(act)` acts, waits until it is at rest again, and is its picture. */
function notebookTest(name, given, run) {
    test(name, { skip: !WIDGET && 'WIDGET is not set' }, async () => {
        const url = pathToFileURL(notebook).href;
        const { context, complaints } = await watched({ deviceScaleFactor: 0.5, viewport: { width: 420, height: 360 } }, url);
        const page = await context.newPage();
        await page.goto(url);
        await page.evaluate(async ([script, traits, glb]) => {
            const bytes = (base64) => {
                const whole = Uint8Array.from(`xx${atob(base64)}`, (c) => c.charCodeAt(0));
                return new DataView(whole.buffer, 2);  // as the kernel's messages give it: in the middle of a buffer
            };
            const values = {
                view: {}, fill: 1, time: 0, ground: 'paper', height: 300, flat: true, sides: null, ...traits, glb: bytes(glb),
            };
            const followers = new Map();
            const change = (key, value) => {
                values[key] = value;
                for (const follow of followers.get(`change:${key}`) ?? []) {
                    follow();
                }
            };
            const model = {
                get: (key) => values[key],
                set: change,
                save_changes() { window.saved = structuredClone(values.view); },
                on(event, follow) { followers.set(event, [...followers.get(event) ?? [], follow]); },
                off(event, follow) { followers.set(event, followers.get(event).filter((other) => other !== follow)); },
            };
            const { default: widget } = await import(URL.createObjectURL(new Blob([script], { type: 'text/javascript' })));
            const cell = document.getElementById('cell');
            const end = await widget.render({ model, el: cell });
            Object.assign(window, { change, bytes, values, followers, end });
        }, [readFileSync(WIDGET, 'utf8'), given, glbs[0]]);
        const state = (value) => page.evaluate((to) => { document.getElementById('cell').dataset.state = to; }, value);
        page.change = (key, value) => page.evaluate(([k, v]) => window.change(k, v), [key, value]);
        page.exchange = (glb) => page.evaluate((bytes) => window.change('glb', window.bytes(bytes)), glb);
        page.shown = async (act) => {
            if (act) {
                await state('asked');
                await act();
            }
            await page.waitForFunction(() => document.getElementById('cell').dataset.state === 'resting');
            return page.locator('canvas').screenshot();
        };
        await page.waitForFunction(() => document.getElementById('cell').dataset.state === 'resting');
        await run(page);
        assert.deepEqual(complaints, []);
        await context.close();
    });
}

/** Largest difference of two pictures' levels. */
const difference = (page, ...pngs) => page.evaluate(async (files) => {
    const [a, b] = await Promise.all(files.map(async (file) => {
        const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${file}`)).blob());
        const context = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
        context.drawImage(picture, 0, 0);
        return context.getImageData(0, 0, picture.width, picture.height).data;
    }));
    return a.reduce((most, level, i) => Math.max(most, Math.abs(level - b[i])), 0);
}, pngs.map((png) => png.toString('base64')));

notebookTest('the widget shows a droplet, and another one from the same side', {}, async (page) => {
    const front = await page.shown();
    assert.equal((await page.locator('canvas').boundingBox()).height, 300);
    const above = await page.shown(() => page.change('view', { elevation: 80 }));
    assert.notDeepEqual(above, front);
    assert.notDeepEqual(await page.shown(() => page.exchange(glbs[1])), above);
    // The camera's place is in lengths of the other droplet meanwhile, which rounds it.
    assert.ok(await difference(page, await page.shown(() => page.exchange(glbs[0])), above) <= 1);
    assert.ok(await difference(page, await page.shown(() => page.change('view', {})), front) <= 1);
});

notebookTest('turning the droplet sets the view, by the mouse and by keys', { view: { azimuth: 20, elevation: 30 } }, async (page) => {
    await page.shown(async () => {
        await page.mouse.move(200, 150);
        await page.mouse.down();
        await page.mouse.move(260, 150, { steps: 4 });
        await page.mouse.up();
    });
    const turned = await page.evaluate(() => window.saved);
    assert.deepEqual(Object.keys(turned), ['azimuth', 'elevation', 'distance', 'target']);
    assert.ok(turned.azimuth < 15 && turned.distance > 0, JSON.stringify(turned));
    await page.shown(() => page.locator('canvas').press('ArrowRight'));
    // The last of the swing, which was too slow to be drawn, comes with the key.
    const { azimuth } = await page.evaluate(() => window.saved);
    assert.ok(Math.abs(azimuth - turned.azimuth - 6) < 0.5, `${turned.azimuth} to ${azimuth}`);
    await page.shown(() => page.locator('canvas').press('Home'));
    assert.deepEqual(await page.evaluate(() => window.saved), {});
});

notebookTest('the view is in degrees and in metres of the file', {
    view: { azimuth: 90, elevation: 10, distance: 0.05, target: [0, 0, 0.001] },
}, async (page) => {
    await page.shown(() => page.locator('canvas').press('ArrowUp'));
    const { azimuth, elevation, distance, target } = await page.evaluate(() => window.saved);
    assert.ok(Math.abs(azimuth - 90) < 0.01 && Math.abs(elevation - 16) < 0.01, `${azimuth} ${elevation}`);
    assert.ok(Math.abs(distance - 0.05) < 1e-6, distance);
    [0, 0, 0.001].forEach((at, k) => assert.ok(Math.abs(target[k] - at) < 1e-9, target));
});

notebookTest('fill, ground and height are followed, and all ends with the cell', {}, async (page) => {
    const full = await page.shown();
    const low = await page.shown(() => page.change('fill', 0.3));
    assert.notDeepEqual(low, full);
    assert.notDeepEqual(await page.shown(() => page.change('ground', 'clay')), low);
    await page.shown(() => page.change('height', 200));
    assert.equal((await page.locator('canvas').boundingBox()).height, 200);
    await page.evaluate(() => window.end());
    assert.ok(await page.evaluate(() => [...window.followers.values()].every((list) => list.length === 0)));
    assert.ok(await page.evaluate(() => document.querySelector('canvas').getContext('webgl2').isContextLost()));
});

notebookTest('what is no GLB is said in the cell', {}, async (page) => {
    await page.evaluate(() => {
        console.error = () => {};
        window.change('glb', window.bytes(btoa('no GLB')));
    });
    await page.waitForFunction(() => document.getElementById('cell').dataset.state === 'failed');
    assert.match(await page.locator('#cell p').textContent(), /does not show the droplet/);
});
