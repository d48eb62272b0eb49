// SPDX-License-Identifier: GPL-3.0-or-later
// What Studio computes without a browser: node --test plain_test.mjs
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { kTables, wordsOfCalls, wordsOfMarkup, wordsOfReports } from './words.mjs';

const { SOURCES = resolve(import.meta.dirname, '../../src') } = process.env;
const module = (path) => import(pathToFileURL(resolve(SOURCES, path)).href);
const { blank, drawPiece, flood, isDry, overlap, shifted } = await module('studio/coverage.js');
const { rimPath } = await module('studio/contour.js');
const { coloursOf, lookNear } = await module('studio/colours.js');
const { History } = await module('live/history.js');
const { kLooks } = await module('studio/looks.js');
const { commandOf, kLayerFields, kSceneFields, optionsOf, settingsOf } = await module('studio/physics.js');
const { boundsOf, largestPlace } = await module('studio/largest_place.js');
const { seedsOf } = await module('studio/mask_finder.js');
const { levelsOf, maskOfLevels } = await module('studio/pictures.js');
const { kTools } = await module('studio/tools.js');
const { decimal, say, speak } = await module('html/words.js');

const area = ({ data }) => data.reduce((sum, value) => sum + value, 0) / 255;
const layerWith = (given) => ({ liquid: settingsOf(kLayerFields, given) });
const scene = settingsOf(kSceneFields);

test('a stroke covers the area of its capsule, wherever it lies', () => {
    for (const [x, y, dx, dy, radius] of [[40, 40, 20, 0, 9], [40.3, 40.7, 13, 17, 9], [50, 50, 0, 0, 20], [40, 50, 20, -7, 3.3]]) {
        const mask = blank(100, 100);
        drawPiece(mask, { x, y, radius }, { x: x + dx, y: y + dy, radius }, false);
        const exact = Math.PI * radius ** 2 + 2 * radius * Math.hypot(dx, dy);
        assert.ok(Math.abs(area(mask) / exact - 1) < 0.005, `${area(mask)} ${exact}`);
    }
});

test('a stroke over itself changes nothing, and the same stroke taken away leaves at most its rim', () => {
    const mask = blank(100, 100);
    const [from, to] = [{ x: 30.2, y: 40, radius: 12 }, { x: 61, y: 55.5, radius: 12 }];
    drawPiece(mask, from, to, false);
    const once = mask.data.slice();
    drawPiece(mask, from, to, false);
    assert.deepEqual(mask.data, once);
    drawPiece(mask, from, to, true);
    once.forEach((before, i) => assert.ok(mask.data[i] <= Math.min(before, 255 - before)));
});

test('the eraser takes away what the brush draws, and the brush with "take away" too', () => {
    const base = blank(64, 64);
    base.data.fill(255);
    const point = { x: 32, y: 32, pressure: 1 };
    const erased = kTools.eraser.begin(base, false, { size: 20 }, point).mask;
    assert.deepEqual(kTools.brush.begin(base, true, { size: 20 }, point).mask, erased);
    assert.ok(Math.abs(64 * 64 - area(erased) - Math.PI * 100) < 2);
    assert.ok(base.data.every((value) => value === 255));
});

test('a flood fills a ring\'s inside and not its outside', () => {
    const mask = blank(100, 100);
    drawPiece(mask, { x: 50, y: 50, radius: 30 }, { x: 50, y: 50, radius: 30 }, false);
    const disc = area(mask);
    drawPiece(mask, { x: 50, y: 50, radius: 20 }, { x: 50, y: 50, radius: 20 }, true);
    flood(mask, 50, 50, false);
    assert.ok(Math.abs(area(mask) - disc) < 1, `${area(mask)} ${disc}`);
    flood(mask, 50, 50, true);
    assert.ok(isDry(mask));
});

test('masks of two levels are read, whatever these are', () => {
    for (const [dry, liquid] of [[0, 255], [0, 1], [0, 20], [255, 0], [255, 220]]) {
        const data = Uint8ClampedArray.from({ length: 4 * 64 }, (_, i) => {
            const [x, y] = [(i >> 2) % 8, i >> 5];
            return i % 4 === 3 ? 255 : x > 1 && x < 6 && y > 1 && y < 6 ? liquid : dry;
        });
        const canvas = { width: 8, height: 8, getContext: () => ({ getImageData: () => ({ data }) }) };
        const levels = levelsOf(canvas);
        const mask = maskOfLevels(levels, levels.threshold, levels.inverted);
        assert.ok(Math.abs(area(mask) - 16) < 0.1, `${dry} ${liquid}: ${area(mask)}`);
    }
});

test('shifting there and back keeps what stays on the sheet', () => {
    const mask = blank(50, 40);
    drawPiece(mask, { x: 25, y: 20, radius: 8 }, { x: 27, y: 20, radius: 8 }, false);
    const moved = shifted(mask, 9, -7);
    assert.equal(area(moved), area(mask));
    assert.deepEqual(shifted(moved, -9, 7), mask);
    assert.ok(isDry(shifted(mask, 50, 0)));
    assert.ok(isDry(shifted(mask, 0, -40)));
    assert.ok(overlap(mask, moved));
    assert.ok(!overlap(mask, blank(50, 40)));
});

test('history goes back and forth, joins runs and bounds its memory', () => {
    const state = (name, mask) => ({ name, layers: [{ mask }] });
    const masks = Array.from({ length: 8 }, () => blank(100, 100));
    const history = new History(state('0', masks[0]), 45_000);
    history.add(state('1', masks[0]));
    history.add(state('2', masks[1]), 'slider');
    history.add(state('3', masks[1]), 'slider');
    assert.equal(history.undo().name, '1');
    assert.equal(history.undo().name, '0');
    assert.equal(history.undo().name, '0');
    assert.equal(history.redo().name, '1');
    assert.equal(history.redo().name, '3');
    assert.equal(history.can_redo, false);
    history.undo();
    history.add(state('4', masks[2]));
    assert.equal(history.can_redo, false);
    masks.forEach((mask, k) => history.add(state(`m${k}`, mask)));
    const held = new Set(history.states.map(({ layers: [{ mask }] }) => mask));
    assert.ok(held.size <= 4 && held.has(masks[7]));
    assert.equal(history.state.name, 'm7');
    assert.equal(history.undo().name, 'm6');
});

test('options are those of the command, without its defaults', () => {
    assert.deepEqual(optionsOf(layerWith({}), scene), { width: '20mm' });
    assert.deepEqual(optionsOf(layerWith({ liquid: 'honey', by: 'volume', volume: 3, fill: 'total', model: 'exact' }), { ...scene, tilt: 30 }),
        { width: '20mm', liquid: 'honey', volume: '3uL', fill: 'total', model: 'exact', tilt: '30deg', tiltDirection: '-90deg' });
    assert.deepEqual(optionsOf(layerWith({ by: 'natural', on: 'wax' }), { ...scene, ground: 'gutter', radius: 33 }),
        { width: '20mm', contactAngle: 'natural', on: 'wax', surface: 'cylinder:R=-33mm,axis=90deg' });
    assert.equal(commandOf('a', { width: '20mm', contactAngle: '35deg', surface: 'cylinder:R=3mm,axis=90deg' }),
        'droplet-shape \'a.png\' \'a.glb\' --width 20mm --contact-angle 35deg --surface \'cylinder:R=3mm,axis=90deg\'');
});

test('values that are not allowed become the first ones', () => {
    const settings = settingsOf(kLayerFields, { liquid: 'lava', contactAngle: 400, volume: '3', density: 900, by: 'toString' });
    assert.deepEqual(settings, { ...settingsOf(kLayerFields), density: 900 });
    assert.deepEqual(settingsOf(kSceneFields, null), scene);
});

test('looks are those of the library', () => {
    const source = readFileSync(resolve(SOURCES, 'surface/material.cpp'), 'utf8');
    const number = '([\\d.]+)';
    const entry = new RegExp(`\\{"(\\w+)", \\{${number}, ${number}, ${number}\\}, ${number}, ${number}, ${number}, ${number}, (true|false)(?:, ThinFilm\\{${number}, ([\\de.-]+)\\})?\\}`, 'g');
    const known = Object.fromEntries([...source.matchAll(entry)].map(([, name, ...values]) => {
        const [red, green, blue, metalness, roughness, transmission, ior] = values.map(Number);
        const look = { colour: [red, green, blue], metalness, roughness, transmission, ior, tinted: values[7] === 'true' };
        return [name, values[8] ? { ...look, film: { ior: Number(values[8]), thickness: Number(values[9]) } } : look];
    }));
    assert.deepEqual(Object.fromEntries(Object.entries(kLooks).map(([name, { ink, ...look }]) => [name, look])), known);
});

test('all languages have the same texts, with the same placeholders', () => {
    const placeholders = (text) => (text.match(/\{\w+\}/g) ?? []).sort();
    const [first, ...others] = Object.values(kTables).map((table) => [...table.keys()]);
    others.forEach((keys) => assert.deepEqual(keys, first));
    for (const [language, table] of Object.entries(kTables)) {
        for (const [english, text] of table) {
            assert.ok(text.trim() === text && text !== '', `${language}: ${english}`);
            assert.deepEqual(placeholders(text), placeholders(english), `${language}: ${english}`);
        }
    }
});

test('every text of the markup and of the scripts is in the tables', () => {
    for (const words of [wordsOfMarkup(), wordsOfCalls(), wordsOfReports()]) {
        assert.ok(words.length > 5);
        assert.deepEqual(words.filter((english) => !kTables.de.has(english)), []);
    }
});

test('a text is said in the chosen language, else in English', () => {
    assert.equal(say('{file} saved', { file: 'a.glb' }), 'a.glb saved');
    assert.equal(decimal('1.25'), '1.25');
    speak({ tag: 'de', point: ',', words: kTables.de });
    assert.equal(say('{file} saved', { file: '{file} $& a.glb' }), '{file} $& a.glb gespeichert');
    assert.equal(say('constructor'), 'constructor');
    assert.equal(say('GLB'), 'GLB');
    assert.equal(decimal('1.25'), '1,25');
    speak();
    assert.equal(say('Undo'), 'Undo');
});

/** A picture of 100 × 60 pixels whose colour is a function of the place; edges are smooth over a pixel. */
function paintedBy(colourAt) {
    const data = new Uint8ClampedArray(4 * 100 * 60);
    for (let i = 0; i < 6000; ++i) {
        const parts = [0.25, 0.75].flatMap((dx) => [0.25, 0.75].map((dy) => colourAt(i % 100 + dx, Math.floor(i / 100) + dy)));
        for (let k = 0; k < 4; ++k) {
            data[4 * i + k] = parts.reduce((sum, part) => sum + part[k], 0) / 4;
        }
    }
    return { width: 100, height: 60, data };
}

test('a logo is divided into its flat colours, with what edges share', () => {
    const [white, red, blue] = [[255, 255, 255, 255], [200, 30, 30, 255], [40, 90, 170, 255]];
    const logo = paintedBy((x, y) => (Math.hypot(x - 30, y - 30) < 20 ? red : Math.hypot(x - 70.3, y - 30) < 15 ? blue : white));
    const layers = coloursOf(logo);
    assert.equal(layers.length, 2);
    for (const [layer, colour, radius, look] of [[layers[0], red, 20, 'lacquer'], [layers[1], blue, 15, 'enamel']]) {
        assert.ok(layer.colour.every((value, k) => Math.abs(value - colour[k]) < 2), `${layer.colour}`);
        const covered = layer.mask.data.reduce((sum, value) => sum + (value >= 128 ? 1 : 0), 0);
        assert.ok(Math.abs(covered / (Math.PI * radius ** 2) - 1) < 0.02, `${covered}`);
        assert.equal(lookNear(layer.colour), look);
    }
    // On nothing, white is a colour like others; a picture of one colour has no layers.
    const bare = paintedBy((x) => (x < 20 ? red : x > 80 ? white : [0, 0, 0, 0]));
    assert.equal(coloursOf(bare).length, 2);
    assert.deepEqual(coloursOf(paintedBy((x) => (x > 30 && x < 60 ? red : white))), []);
});

/** Area within the loops of a path: with liquid on the right, positive around liquid and negative around a hole. */
const loopsOf = (path) => path.split('Z').filter((loop) => loop !== '').map((loop) => {
    const points = loop.slice(1).split('L').map((point) => point.split(' ').map(Number));
    return points.reduce((sum, [x, y], k) => {
        const [nextX, nextY] = points[(k + 1) % points.length];
        return sum + (x * nextY - nextX * y) / 2;
    }, 0);
});

test('the rim of a mask runs around its liquid and its holes, also at the border', () => {
    const mask = blank(80, 60);
    const disc = (x, y, radius, removes) => drawPiece(mask, { x, y, radius }, { x, y, radius }, removes);
    disc(30, 30, 20, false);
    disc(30, 30, 8, true);
    disc(80, 60, 15, false);
    const areas = loopsOf(rimPath(mask)).sort((a, b) => a - b);
    for (const [k, exact] of [-64 * Math.PI, 225 / 4 * Math.PI, 400 * Math.PI].entries()) {
        assert.ok(Math.abs(areas[k] / exact - 1) < 0.02, `${areas}`);
    }
    assert.equal(areas.length, 3);
    assert.equal(rimPath(blank(5, 5)), '');
    // Pixels that touch at a corner, and a sheet that is all liquid.
    const corners = { width: 2, height: 2, data: Uint8Array.of(255, 0, 0, 255) };
    assert.equal(loopsOf(rimPath(corners)).length, 2);
    assert.deepEqual(loopsOf(rimPath({ width: 3, height: 2, data: new Uint8Array(6).fill(255) })).map(Math.round), [6]);
});

test('strokes stay on a smaller picture: white on liquid, black on dry ground', () => {
    const [liquid, dry] = [blank(100, 40), blank(100, 40)];
    liquid.data[0] = 255;
    dry.data[40 * 100 - 1] = 255;
    dry.data[50] = 100;  // the stroke's soft edge
    const { width, height, data } = seedsOf({ liquid, dry }, 10, 4);
    assert.deepEqual([width, height, data.length], [10, 4, 160]);
    assert.deepEqual([...data.slice(0, 4)], [255, 255, 255, 255]);
    assert.deepEqual([...data.slice(-4)], [0, 0, 0, 255]);
    assert.equal(data.filter((value, i) => i % 4 === 3 && value > 0).length, 2);
});

test('a drawing has most room in the largest rectangle of its aspect', () => {
    const cover = blank(192, 96);
    const rectangle = (left, top, right, bottom) => {
        for (let y = top; y < bottom; ++y) {
            cover.data.fill(255, y * 192 + left, y * 192 + right);
        }
    };
    rectangle(10, 10, 180, 30);
    rectangle(100, 40, 140, 90);
    assert.deepEqual(largestPlace(cover, 8), { left: 10, top: 10, right: 180, bottom: 30 });
    assert.deepEqual(largestPlace(cover, 1), { left: 100, top: 40, right: 140, bottom: 90 });
    assert.equal(largestPlace(blank(192, 96), 1), undefined);
    assert.deepEqual(boundsOf([cover, blank(192, 96)]), { left: 10, top: 10, right: 180, bottom: 90 });
    assert.equal(boundsOf([blank(4, 4)]), undefined);
});
