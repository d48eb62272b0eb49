// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `droplet-shape windshield --live` in a real browser: node --test rain_test.mjs
// RAIN is the page, made with --warm-up 2s --glass-width 0.4m --glass-height 0.25m; DROPLET_SHAPE the command; for the rest see
// browser.mjs.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { dropFiles, folder, watched } from './browser.mjs';

const { RAIN, DROPLET_SHAPE } = process.env;
const kPage = pathToFileURL(resolve(RAIN)).href;
const kSize = { width: 400, height: 225 };  // small, since rendering is in software

const state = (page, name) => page.evaluate((key) => document.documentElement.dataset[key], name);

async function frames(page, count) {
    const now = Number(await state(page, 'frames'));
    await page.waitForFunction((until) => Number(document.documentElement.dataset.frames) >= until, now + count);
}

const setValue = (page, name, value) => page.locator(`#rain-${name}`).evaluate((slider, to) => {
    slider.value = to;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
}, String(value));

/** Red, green and blue of all pixels of a part of the page. */
async function pixels(page, clip) {
    const png = await page.screenshot({ clip });
    return page.evaluate(async (base64) => {
        const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
        const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
        context.drawImage(image, 0, 0);
        return [...context.getImageData(0, 0, image.width, image.height).data].filter((_, k) => k % 4 < 3);
    }, png.toString('base64'));
}

const difference = (a, b) => a.reduce((sum, value, k) => sum + Math.abs(value - b[k]), 0) / a.length;
const mean = (all, channel) => all.filter((_, k) => k % 3 === channel).reduce((a, b) => a + b) / (all.length / 3);

/** Runs a test in a page of its own, in which nothing may complain and nothing may be fetched. */
function rain(name, run, options = { viewport: kSize }, pageOf = () => kPage) {
    test(name, async () => {
        const url = pageOf();
        const { context, complaints } = await watched(options, url);
        const page = await context.newPage();
        await page.goto(url);
        await page.waitForFunction(() => document.documentElement.dataset.state === 'running');
        // Neither the bar nor its fading is part of the picture.
        await page.evaluate(() => {
            document.querySelectorAll('.rain .bar, .rain .hint').forEach((part) => { part.style.visibility = 'hidden'; });
            document.querySelectorAll('.rain canvas').forEach((part) => { part.style.transition = 'none'; });
        });
        await run(page);
        assert.deepEqual(complaints, []);
        await context.close();
    });
}

test('the command puts its options and a picture into the page', () => {
    const png = Buffer.from('iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg==', 'base64');
    writeFileSync(join(folder, 'road.png'), png);
    const write = (...words) => execFileSync(DROPLET_SHAPE, ['windshield', '--live', join(folder, 'rain.html'), ...words], { stdio: 'pipe' });
    write('--rain', '36mm/h', '--mist', '1.8mm/h', '--speed', '36km/h', '--wiper-period', '2s', '--preset', 'figure-3.11', '--warm-up', '4s', '--eye-distance', '0.4m',
        '--background', join(folder, 'road.png'));
    const page = readFileSync(join(folder, 'rain.html'), 'utf8');
    const { parameters, ...values } = JSON.parse(page.match(/id="rain-values" type="application\/json">(.*)<\/script>/)[1]);
    assert.deepEqual(values, { preset: 'figure-3.11', warm_up: 4, eye_distance: 0.4, background: `data:image/png;base64,${png.toString('base64')}` });
    assert.ok(Math.abs(parameters.rain - 1e-5) < 1e-12);
    assert.ok(Math.abs(parameters.mist - 5e-7) < 1e-12);
    assert.deepEqual([parameters.speed, parameters.wiperPeriod, parameters.hysteresis, parameters.glassWidth], [10, 2, 0.05, 1.4]);
    writeFileSync(join(folder, 'road.mp4'), 'no picture');
    assert.throws(() => write('--background', join(folder, 'road.mp4')), /a PNG, JPEG, WebP or GIF with --live/);
    assert.throws(() => write('--no-clobber'), /rain.html/);
});

rain('it rains, and a pause holds the rain', async (page) => {
    await frames(page, 2);
    const first = await pixels(page);
    await frames(page, 6);
    const later = await pixels(page);
    assert.ok(difference(first, later) > 0.2);
    await frames(page, 46);
    console.log(`simulation and maps: ${await state(page, 'busy')} ms a frame, maps ${await state(page, 'map')} px wide`);
    await page.keyboard.press(' ');
    await page.waitForFunction(() => document.documentElement.dataset.state === 'paused');
    const held = await pixels(page);
    await page.waitForTimeout(300);
    assert.equal(difference(held, await pixels(page)), 0);
});

rain('a finger wipes mist and droplets', async (page) => {
    await setValue(page, 'mist', 1);
    await setValue(page, 'noise', 0);
    for (const _ of [1, 2, 3]) {
        await frames(page, 40);
    }
    await page.keyboard.press(' ');
    await page.waitForFunction(() => document.documentElement.dataset.state === 'paused');
    const wiped = { x: 120, y: 95, width: 160, height: 30 };
    const elsewhere = { x: 120, y: 20, width: 160, height: 30 };
    const before = [await pixels(page, wiped), await pixels(page, elsewhere)];
    await page.mouse.move(100, 110);
    await page.mouse.down();
    await page.mouse.move(300, 110, { steps: 8 });
    await page.mouse.up();
    await frames(page, 2);
    const changes = [difference(before[0], await pixels(page, wiped)), difference(before[1], await pixels(page, elsewhere))];
    assert.ok(changes[0] > 3 && changes[1] < 0.5 * changes[0], `${changes}`);
});

rain('a picture that is dropped is behind the glass', async (page) => {
    await setValue(page, 'rain', 0);
    await page.evaluate(async () => {
        const canvas = new OffscreenCanvas(320, 180);
        const context = canvas.getContext('2d');
        context.fillStyle = '#20c040';
        context.fillRect(0, 0, 320, 180);
        const data = new DataTransfer();
        data.items.add(new File([await canvas.convertToBlob()], 'green.png', { type: 'image/png' }));
        document.querySelector('.rain').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    });
    await page.waitForFunction(() => document.documentElement.dataset.backdrop === 'own');
    await frames(page, 3);
    const seen = await pixels(page, { x: 150, y: 80, width: 100, height: 60 });
    const [red, green, blue] = [0, 1, 2].map((channel) => mean(seen, channel));
    assert.ok(green > 130 && red < 0.5 * green && blue < 0.6 * green, `${[red, green, blue]}`);
    await page.evaluate(() => {
        const data = new DataTransfer();
        data.items.add(new File(['no picture'], 'notes.txt', { type: 'text/plain' }));
        document.querySelector('.rain').dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
    });
    await page.waitForFunction(() => document.documentElement.dataset.backdrop === 'failed');
});

/** Drops a file on the page: a video or picture that ffmpeg makes of its source, and waits until it is behind the glass. */
async function dropMade(page, name, type, ...source) {
    const path = join(folder, name);
    execFileSync('ffmpeg', ['-v', 'error', '-y', '-f', 'lavfi', ...source, path]);
    await page.evaluate(() => { document.documentElement.dataset.backdrop = 'none yet'; });
    await dropFiles(page, '.rain', [name, type, readFileSync(path)]);
    await page.waitForFunction(() => document.documentElement.dataset.backdrop === 'own');
}

/** Mean red, green and blue of a part of the page. */
async function colour(page, clip) {
    const seen = await pixels(page, clip);
    return [0, 1, 2].map((channel) => mean(seen, channel));
}

rain('a video that is dropped plays behind the glass', async (page) => {
    await setValue(page, 'rain', 0);
    // Half a second of red, then of blue, again and again.
    await dropMade(page, 'film.webm', 'video/webm', '-i', 'color=red:size=320x180:rate=10:duration=0.5', '-f', 'lavfi',
        '-i', 'color=blue:size=320x180:rate=10:duration=0.5', '-filter_complex', 'concat', '-c:v', 'libvpx');
    const seen = new Set();
    for (let k = 0; k < 60 && seen.size < 2; ++k) {
        await frames(page, 1);
        const [red, , blue] = await colour(page, { x: 150, y: 80, width: 100, height: 60 });
        seen.add(red > 2 * blue ? 'red' : blue > 2 * red ? 'blue' : '');
        seen.delete('');
    }
    assert.deepEqual([...seen].sort(), ['blue', 'red']);
});

rain('a panorama that is dropped is all around: the frame shows its middle', async (page) => {
    await setValue(page, 'rain', 0);
    // Green in the middle third, red beside it; a picture in the frame's shape would show both.
    const file = ['-i', 'color=red:size=600x300', '-frames:v', '1', '-vf', 'drawbox=x=200:w=200:h=300:c=0x20c040:t=fill'];
    await dropMade(page, 'around.png', 'image/png', ...file);
    await frames(page, 3);
    for (const x of [60, 300]) {
        const [red, green] = await colour(page, { x, y: 80, width: 40, height: 40 });
        assert.ok(green > 2 * red, `${[red, green]} at ${x}`);
    }
    await dropMade(page, 'ahead.png', 'image/png', '-i', 'color=red:size=640x300', '-frames:v', '1', '-vf', 'drawbox=x=240:w=160:h=300:c=0x20c040:t=fill');
    await frames(page, 3);
    const [red, green] = await colour(page, { x: 60, y: 80, width: 40, height: 40 });
    assert.ok(red > 2 * green, `${[red, green]}`);
});

/** A flat pane of 0.4 m by 0.2 m at 45°, half as wide at its lower edge, as bytes of a .glb. */
function paneGlb() {
    const uvs = [[0, 0], [1, 0], [0.75, 0.5], [0.25, 0.5]];
    const up = (v) => 0.4 * (0.5 - v) * Math.SQRT1_2;
    const parts = [
        new Float32Array(uvs.flatMap(([u, v]) => [0.4 * u - 0.2, up(v), -up(v)])), new Float32Array(uvs.flatMap(() => [0, Math.SQRT1_2, Math.SQRT1_2])),
        new Float32Array(uvs.flat()), new Uint32Array([0, 3, 2, 0, 2, 1]),
    ].map((numbers) => Buffer.from(numbers.buffer));
    const views = parts.map(({ length }, k) => ({ buffer: 0, byteOffset: parts.slice(0, k).reduce((sum, part) => sum + part.length, 0), byteLength: length }));
    const low = [-0.2, 0, -up(0)].map(Math.fround);
    const high = [0.2, up(0), 0].map(Math.fround);
    const float = (bufferView, type, more) => ({ bufferView, componentType: 5126, count: 4, type, ...more });
    const json = Buffer.from(JSON.stringify({
        asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], buffers: [{ byteLength: Buffer.concat(parts).length }],
        meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1, TEXCOORD_0: 2 }, indices: 3 }] }], bufferViews: views,
        accessors: [float(0, 'VEC3', { min: low, max: high }), float(1, 'VEC3'), float(2, 'VEC2'), { bufferView: 3, componentType: 5125, count: 6, type: 'SCALAR' }],
    }));
    const padded = Buffer.concat([json, Buffer.alloc((4 - json.length % 4) % 4, ' ')]);
    const chunk = (kind, bytes) => Buffer.concat([Buffer.from(new Uint32Array([bytes.length]).buffer), Buffer.from(kind), bytes]);
    const body = Buffer.concat([chunk('JSON', padded), chunk('BIN\0', Buffer.concat(parts))]);
    return Buffer.concat([Buffer.from('glTF'), Buffer.from(new Uint32Array([2, 12 + body.length]).buffer), body]);
}

rain('it rains on a mesh, whose edge is that of the glass', async (page) => {
    assert.equal(await page.locator('#rain-slope').count(), 0);
    await setValue(page, 'wiperPeriod', 1.2);
    await frames(page, 60);
    await setValue(page, 'wiperPeriod', 0);
    await setValue(page, 'rain', 0);
    await dropMade(page, 'green.png', 'image/png', '-i', 'color=0x20c040:size=320x180', '-frames:v', '1');
    await frames(page, 3);
    const [, green] = await colour(page, { x: 180, y: 100, width: 40, height: 24 });
    assert.ok(green > 100, `${green}`);
    // Beside the lower edge, which is shorter than the upper one, there is no glass.
    for (const x of [47, 321]) {
        const beside = await colour(page, { x, y: 126, width: 32, height: 20 });
        assert.ok(Math.max(...beside) < 20, `${beside} at ${x}`);
    }
}, { viewport: kSize }, () => {
    writeFileSync(join(folder, 'pane.glb'), paneGlb());
    const path = join(folder, 'mesh.html');
    execFileSync(DROPLET_SHAPE, ['windshield', '--live', path, '--surface', join(folder, 'pane.glb'), '--warm-up', '1s', '--eye-distance', '0.6m'], { stdio: 'pipe' });
    const { surface, parameters } = JSON.parse(readFileSync(path, 'utf8').match(/id="rain-values" type="application\/json">(.*)<\/script>/)[1]);
    const numbers = new Float32Array(new Uint8Array(Buffer.from(surface.uvs, 'base64')).buffer);
    assert.deepEqual([...numbers], [0, 0, 1, 0, 0.75, 0.5, 0.25, 0.5]);
    assert.ok(!('slope' in parameters) && parameters.gravity > 9);
    return pathToFileURL(path).href;
});

rain('a recording is a video, and a saved picture has the frame’s size', async (page) => {
    await page.keyboard.press('r');
    await frames(page, 12);
    const [video] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('r')]);
    const path = join(folder, video.suggestedFilename());
    await video.saveAs(path);
    const about = JSON.parse(execFileSync('ffprobe', ['-v', 'error', '-show_streams', '-count_frames', '-of', 'json', path]));
    assert.equal(about.streams[0].codec_type, 'video');
    assert.ok(Number(about.streams[0].nb_read_frames) > 2);
    const [picture] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('s')]);
    await picture.saveAs(join(folder, 'rain.png'));
    const { streams } = JSON.parse(execFileSync('ffprobe', ['-v', 'error', '-show_streams', '-of', 'json', join(folder, 'rain.png')]));
    assert.ok(streams[0].width > 100 && Math.abs(streams[0].width / streams[0].height - kSize.width / kSize.height) < 0.02);
});

rain('figures of the thesis and coatings set the sliders; slope begins again', async (page) => {
    const text = (name) => page.locator(`output[for=rain-${name}]`).evaluate((output) => output.textContent);
    await page.keyboard.press('h');
    await page.locator('[id="rain-figure-3.11"]').click();
    assert.deepEqual([await text('hysteresis'), await text('speed')], ['0.05', '41 km/h']);
    await page.getByRole('button', { name: 'Rain repellent' }).click();
    assert.deepEqual([await text('contactAngle'), await text('hysteresis'), await text('kineticFraction')], ['108°', '0.12', '0.80']);
    await setValue(page, 'slope', 70);
    await page.waitForTimeout(600);
    await frames(page, 2);
    assert.equal(await text('slope'), '70°');
});

rain('on a phone the panel is reachable and nothing overflows', async (page) => {
    await page.keyboard.press('h');
    await page.waitForFunction(() => {
        const { left, right, top, bottom } = document.querySelector('.rain .panel').getBoundingClientRect();
        return left >= 0 && right <= innerWidth && top > 200 && bottom <= innerHeight + 1;
    });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth));
    for (const button of await page.locator('.rain .bar button').all()) {
        const { x, width } = await button.boundingBox();
        assert.ok(x >= 0 && x + width <= 390 && width > 30, `${x} + ${width}`);
    }
}, { viewport: { width: 390, height: 844 }, deviceScaleFactor: 0.5, hasTouch: true, isMobile: true });
