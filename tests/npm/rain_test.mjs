// SPDX-License-Identifier: GPL-3.0-or-later
// The windshield of the npm package, as its users have it, beside the command's: PROGRAM=… PACKAGE=… node --test rain_test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';

const folder = mkdtempSync(join(tmpdir(), 'droplet-rain-'));
after(() => rmSync(folder, { recursive: true }));

const { DropletError, halfFloat, windshield } = await import(join(process.env.PACKAGE, 'windshield.js'));

const kStep = 1 / 60;
const kGlass = { glassWidth: 0.3, glassHeight: 0.2 };
const mmPerHour = (value) => value / 3.6e6;

function advance(rain, seconds) {
    for (let k = Math.round(seconds / kStep); k > 0; --k) {
        rain.advance(kStep);
    }
}

test('the same parameters have the command’s droplets and water', async () => {
    const rain = await windshield({ ...kGlass, rain: mmPerHour(50), speed: 15, runoff: 1 });
    advance(rain, 3 - kStep);  // the last frame of three seconds
    const report = JSON.parse(execFileSync(process.env.PROGRAM, ['windshield', join(folder, 'last.png'), '--time', '3s', '--warm-up', '0s',
        '--fps', '60', '--rain', '50mm/h', '--speed', '15m/s', '--glass-width', '0.3m', '--glass-height', '0.2m', '--frame-size', '160x90',
        '--samples', '1', '--quiet', '--json', '-']));
    const last = report.balance.at(-1);
    const figures = rain.figures();
    assert.ok(Math.abs(figures.time - last.time_s) < 1e-6);
    assert.equal(figures.running, last.running_droplets);
    assert.equal(figures.still, last.still_droplets);
    const water = last.on_glass_still_m3 + last.on_glass_film_m3 + last.on_glass_running_m3;
    const { volume } = rain.water();
    assert.ok(Math.abs(volume - water) < 1e-6 * water, `${volume} m³, not ${water} m³`);
});

test('what is touched, sprayed and wiped keeps its water', async () => {
    const rain = await windshield({ ...kGlass, rain: mmPerHour(100), speed: 12, mist: 5e-7, wiperPeriod: 1.5 });
    for (let k = 0; k < 180; ++k) {
        rain.finger({ from: { x: 0.05 + k / 1000, y: 0.1 }, to: { x: 0.051 + k / 1000, y: 0.1 } });
        rain.spray({ x: 0.2, y: 0.15, radius: 0.02, volume: 1e-8 });
        rain.advance(kStep);
    }
    const { running, still } = rain.figures();
    const { volume, balanceError } = rain.water();
    assert.ok(volume > 0 && running > 0 && still > 0);
    assert.ok(Math.abs(balanceError) < 1e-9, `${balanceError}`);
    assert.equal(rain.running().length, running);
});

test('what changes is listed, and the pixels are those of maps that begin now', async () => {
    const values = { ...kGlass, rain: mmPerHour(60), speed: 14, mapWidth: 300 };
    const [kept, fresh] = [await windshield(values), await windshield(values)];
    const before = new Uint16Array(4 * 300 * kept.mapHeight);
    for (let k = 0; k < 90; ++k) {
        [kept, fresh].forEach((rain) => rain.advance(kStep));
        const { width, tiles, pixels } = kept.draw();
        for (const { x, y, width: across, height: down } of tiles) {
            for (let row = y; row < y + down; ++row) {
                const [begin, end] = [x, x + across].map((column) => 4 * (row * width + column));
                before.set(pixels.subarray(begin, end), begin);
            }
        }
        assert.deepEqual(before, pixels, `step ${k}`);
    }
    const all = fresh.draw();
    assert.equal(all.tiles.length, Math.ceil(all.width / 32) * Math.ceil(all.height / 32));
    assert.deepEqual(all.pixels, kept.draw().pixels);
    // The thickness of all pixels is the water.
    const pixel = kGlass.glassWidth * kGlass.glassHeight / (all.width * all.height);
    let water = 0;
    for (let k = 2; k < all.pixels.length; k += 4) {
        water += 1e-3 * halfFloat(all.pixels[k]) * pixel;
    }
    const { volume } = kept.water();
    assert.ok(Math.abs(water - volume) < 0.03 * volume, `${water} m³, not ${volume} m³`);
});

test('a finger leaves clear glass in mist', async () => {
    const rain = await windshield({ ...kGlass, rain: 0, speed: 0, mist: 1e-6 });
    advance(rain, 5);
    const at = ({ width, height, pixels, right, top }, x, y) =>
        pixels[Math.floor((1 - y / kGlass.glassHeight / top) * height) * width + Math.floor(x / kGlass.glassWidth / right * width)];
    const misty = at(rain.mist(), 0.15, 0.1);
    assert.ok(misty > 100, `${misty}`);
    rain.finger({ from: { x: 0.1, y: 0.1 }, to: { x: 0.2, y: 0.1 }, width: 0.03 });
    assert.equal(at(rain.mist(), 0.15, 0.1), 0);
    assert.ok(at(rain.mist(), 0.15, 0.18) >= misty);
});

test('places and blades are those of the glass', async () => {
    const rain = await windshield({ wiperPeriod: 2 });
    const { width, height } = rain.figures();
    const { point, normal, across, up } = rain.place(width / 2, height);
    const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);
    assert.ok(Math.abs(point[0]) < 1e-12 && Math.abs(Math.hypot(...point) - height) < 1e-9);
    for (const [a, b, expected] of [[normal, normal, 1], [normal, up, 0], [across, up, 0], [up, up, 1]]) {
        assert.ok(Math.abs(dot(a, b) - expected) < 1e-9);
    }
    advance(rain, 0.5);
    const [left, right] = rain.blades();
    assert.ok(left.outer.y > left.inner.y && right.outer.x > left.outer.x);
    for (const { inner, outer, pivot, first, last } of [left, right]) {
        const angles = [inner, outer].map(({ x, y }) => Math.atan2(y - pivot.y, x - pivot.x));
        assert.ok(Math.abs(angles[0] - angles[1]) < 1e-9 && angles[0] > first && angles[0] < last);
    }
});

/** A flat pane of 0.4 m by 0.2 m at 45°, whose lower corners are cut off. */
function pane() {
    const uvs = [[0, 0], [1, 0], [1, 0.25], [0.75, 0.5], [0.25, 0.5], [0, 0.25]];
    const up = (v) => 0.4 * (0.5 - v) * Math.SQRT1_2;
    return {
        positions: uvs.flatMap(([u, v]) => [0.4 * u, up(v), up(v)]), normals: uvs.flatMap(() => [0, -Math.SQRT1_2, Math.SQRT1_2]), uvs: uvs.flat(),
        indices: [0, 5, 2, 0, 2, 1, 5, 4, 3, 5, 3, 2],
    };
}

test('it rains on a mesh', async () => {
    const rain = await windshield({ surface: pane(), rain: mmPerHour(80), speed: 10, wiperPeriod: 1.5 });
    const { width, height } = rain.figures();
    assert.ok(Math.abs(width - 0.4) < 1e-6 && Math.abs(height - 0.2) < 1e-6);
    const triangles = rain.triangles();
    const area = triangles.reduce((sum, [a, b, c]) => sum + 0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)), 0);
    assert.ok(Math.abs(area - 0.07) < 1e-6, `${area}`);
    for (const { y, point, up } of triangles.flat()) {
        assert.ok(Math.abs(point[2] - y * Math.SQRT1_2) < 1e-6 && Math.abs(up[2] - Math.SQRT1_2) < 1e-6);
    }
    assert.throws(() => rain.place(0.01, 0.01), /there is no glass/);
    advance(rain, 2);
    const { running } = rain.figures();
    const { volume, balanceError } = rain.water();
    assert.ok(running > 0 && volume > 0 && Math.abs(balanceError) < 1e-9);
    rain.running().forEach(({ x, y }) => rain.place(x, y));  // none is beside the glass
    // What is drawn there is bare.
    const { width: across, height: down, pixels } = rain.draw();
    assert.equal(pixels[4 * ((down - 2) * across + 1) + 3], 0);
    await assert.rejects(windshield({ surface: pane(), slope: 1 }), /slope: the glass is a mesh/);
    await assert.rejects(windshield({ surface: { ...pane(), uvs: [0, 0] } }), /surface.uvs: 2 numbers/);
    await assert.rejects(windshield({ surface: { ...pane(), indices: [0, 1, 9] } }), /triangles\[0\] names vertex 9 of 6/);
});

test('arguments are refused by name', async () => {
    const rain = await windshield();
    const refused = (work, text) => assert.throws(work, (error) => error instanceof DropletError && error.code === 'InvalidArgument' && text.test(error.message));
    refused(() => rain.set({ speed: -1 }), /speed is -1; it must be from 0 to 150/);
    refused(() => rain.set({ sped: 1 }), /sped: unknown parameter; known are /);
    refused(() => rain.set({ speed: '14' }), /speed: "14" must be a number/);
    refused(() => rain.advance(0), /seconds/);
    rain.advance(kStep);
    refused(() => rain.set({ slope: 1 }), /slope must be set before the first step/);
    await assert.rejects(windshield({ preset: 'figure-3.13' }), /figure-3.13/);
    rain.free();
    refused(() => rain.figures(), /freed/);
});
