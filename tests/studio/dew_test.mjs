// SPDX-License-Identifier: GPL-3.0-or-later
// Covers objects with dew in Studio, in a real browser: node --test dew_test.mjs
// DROPLET_SHAPE is the command, whose droplets are compared; VALIDATOR the script that checks glTF.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { dropFiles, folder, jsonOf, kDesktop, kPhone, saved as savedBy, started, studio } from './browser.mjs';
import { drawThrough, setValue, stateOfDew } from './controls.mjs';

const { DROPLET_SHAPE, VALIDATOR } = process.env;

const saved = (page, kind) => savedBy(page, `[data-dew-save=${kind}]`);
const result = async (page) => (await page.locator('#result').textContent()).replaceAll(/\s/g, ' ');

/** Words of the command that Studio shows, after the object and the output. */
const words = async (page) => (await page.locator('#command').textContent()).match(/'([^']*)' '([^']*)' ?(.*)/)[3].split(' ').filter(Boolean);

/** A lump of 2 cm with bumps [m], few droplets of which browsers draw fast: vertices by rings and columns, and triangles. */
function lump(rings = 30, columns = 60) {
    const [vertices, faces] = [[], []];
    for (let i = 0; i <= rings; ++i) {
        for (let k = 0; k < columns; ++k) {
            const [polar, angle] = [Math.PI * (i + 0.5) / (rings + 1), 2 * Math.PI * k / columns];
            const radius = 0.01 + 0.0007 * Math.sin(5 * angle) * Math.sin(4 * polar);
            vertices.push([radius * Math.sin(polar) * Math.cos(angle), radius * Math.sin(polar) * Math.sin(angle), radius * Math.cos(polar)]);
            if (i < rings) {
                const [a, b] = [i * columns + k, i * columns + (k + 1) % columns];
                faces.push([a, a + columns, b + columns], [a, b + columns, b]);
            }
        }
    }
    for (const [ring, flip] of [[0, false], [rings * columns, true]]) {
        for (let k = 1; k + 1 < columns; ++k) {
            faces.push(flip ? [ring, ring + k + 1, ring + k] : [ring, ring + k, ring + k + 1]);
        }
    }
    return { vertices, faces };
}

const { vertices, faces } = lump();
const ply = Buffer.from(['ply', 'format ascii 1.0', `element vertex ${vertices.length}`, 'property float x', 'property float y', 'property float z',
    `element face ${faces.length}`, 'property list uchar int vertex_indices', 'end_header',
    ...vertices.map((v) => v.map((x) => x.toFixed(7)).join(' ')), ...faces.map((face) => `3 ${face.join(' ')}`), ''].join('\n'));
/** The lump in blue. */
const blue = [
    ['blue.obj', '', Buffer.from(['mtllib blue.mtl', 'usemtl blue', ...vertices.map((v) => `v ${v.map((x) => (1000 * x).toFixed(4)).join(' ')}`),
        ...faces.map((face) => `f ${face.map((corner) => corner + 1).join(' ')}`), ''].join('\n'))],
    ['blue.mtl', '', Buffer.from('newmtl blue\nKd 0.02 0.05 0.7\n')],
];

/** Opens the part and drops an object onto it. */
async function cover(page, ...files) {
    await dropFiles(page, '#view', ...files);
    await stateOfDew(page, 'ready');
}

if (DROPLET_SHAPE) {
    studio('droplets of a dropped object are those of the command, and its files are valid', kDesktop, async (page) => {
        await cover(page, ['lump.ply', '', ply]);
        await page.locator('#dew-kinds [value=rain]').check({ force: true });
        await setValue(page, 'dew-objectSize', 24);
        await setValue(page, 'dew-coverage', 30);
        await setValue(page, 'dew-smallest', 0.4);
        await setValue(page, 'dew-seed', 5);
        await stateOfDew(page, 'ready');
        const object = join(folder, 'lump.ply');
        writeFileSync(object, ply);
        const made = join(folder, 'made.glb');
        const given = await words(page);
        assert.deepEqual(given, ['--preset', 'rain', '--object-size', '24mm', '--coverage', '0.3', '--smallest', '0.4mm', '--seed', '5']);
        const { droplets } = JSON.parse(execFileSync(DROPLET_SHAPE, ['dew', object, made, ...given, '--json', '-', '--quiet']));
        const figures = await page.locator('#figures table').innerText();
        assert.match(figures.replaceAll('\u2009', ''), new RegExp(`Droplets\\s+${droplets.count}\\n`));
        assert.match((await result(page)).replace(/(\d) (?=\d{3} )/, '$1'), new RegExp(`^${droplets.count} droplets, [\\d.]+ .L on [\\d.]+ %$`));
        const glb = await saved(page, 'glb');
        assert.equal(glb.name, 'lump-dew.glb');
        assert.ok(Math.abs(glb.bytes.length / readFileSync(made).length - 1) < 0.01);
        const files = [glb.path];
        for (const [instancing, compress, extension] of [['gpu', '', 'EXT_mesh_gpu_instancing'], ['nodes', 'quantize', 'KHR_mesh_quantization'],
            ['none', 'meshopt', 'EXT_meshopt_compression']]) {
            await setValue(page, 'dew-instancing', instancing);
            await setValue(page, 'dew-compress', compress);
            const file = await saved(page, 'glb');
            const json = jsonOf(file.bytes);
            assert.ok(json.extensionsRequired.includes(extension), instancing);
            assert.equal(json.nodes[0].name, 'object');
            files.push(join(folder, `${instancing}.glb`));
            writeFileSync(files.at(-1), file.bytes);
        }
        if (VALIDATOR) {
            execFileSync('node', [VALIDATOR, ...files], { stdio: 'pipe' });
        }
        assert.equal((await saved(page, 'csv')).bytes.filter((byte) => byte === 10).length, 1 + droplets.count);
        assert.equal((await saved(page, 'usdz')).bytes.subarray(0, 2).toString(), 'PK');
        assert.equal((await saved(page, 'obj')).bytes.subarray(0, 1).toString(), '#');
        const stl = (await saved(page, 'stl')).bytes;
        assert.equal(stl.length, 84 + 50 * stl.readUInt32LE(80));
        assert.equal((await saved(page, 'view')).bytes.subarray(1, 4).toString(), 'PNG');
    });
}

/** Brightness of the darkest part of the ground, right of the object and below: 0 to 255. */
async function darkestGround(page) {
    const shown = (await page.locator('#view').screenshot()).toString('base64');
    return page.evaluate(async (png) => {
        const picture = await createImageBitmap(new Blob([Uint8Array.from(atob(png), (c) => c.charCodeAt(0))]));
        const { width, height } = picture;
        const context = new OffscreenCanvas(16, 16).getContext('2d');
        context.imageSmoothingQuality = 'high';
        context.drawImage(picture, 0.62 * width, 0.75 * height, 0.3 * width, 0.22 * height, 0, 0, 16, 16);
        const { data } = context.getImageData(0, 0, 16, 16);
        return Math.min(...Array.from({ length: 256 }, (_, k) => Math.max(...data.slice(4 * k, 4 * k + 3))));
    }, shown);
}

studio('the bottle comes also if it is asked for at once, and casts a shadow', kDesktop, async (page) => {
    await page.locator('#modes [value=dew]').evaluate((mode) => {
        mode.click();
        document.getElementById('dew-bottle').click();  // before the options are there
    });
    const bare = await darkestGround(page);
    await stateOfDew(page, 'ready');
    await page.waitForFunction(() => document.documentElement.dataset.state === 'resting');
    assert.equal(await page.locator('#dew-name').textContent(), 'bottle.obj');
    const shaded = await darkestGround(page);
    assert.ok(shaded < 0.6 * bare, `${shaded}, ${bare} without`);
});

studio('the object has its colours, and droplets are seen on it', kDesktop, async (page) => {
    await page.evaluate(() => document.querySelector('#swatches [value=white]').click());  // the first ground is bluish
    await cover(page, ...blue);
    const colourful = async () => {
        await page.waitForFunction(() => document.documentElement.dataset.state === 'resting');
        const png = await page.locator('#view').screenshot();
        return page.evaluate(async (base64) => {
            const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
            const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
            context.drawImage(image, 0, 0);
            const { data } = context.getImageData(0, 0, image.width, image.height);
            let count = 0;
            for (let i = 0; i < data.length; i += 4) {
                count += data[i + 2] > data[i] + 40;  // the object's blue
            }
            return 4 * count / data.length;
        }, png.toString('base64'));
    };
    assert.ok(await colourful() > 0.03);
    // A figure follows a slider; undo and redo go through settings.
    const few = await result(page);
    await setValue(page, 'dew-coverage', 10);
    await stateOfDew(page, 'ready');
    const changed = await result(page);
    assert.notEqual(changed, few);
    await page.keyboard.press('Control+z');
    await stateOfDew(page, 'ready');
    assert.equal(await result(page), few);
    await page.locator('#redo').click();
    await stateOfDew(page, 'ready');
    assert.equal(await result(page), changed);
    // A kind of wetness has its own values.
    await page.locator('#dew-kinds [value=shower]').check({ force: true });
    await stateOfDew(page, 'ready');
    assert.equal(Number(await page.locator('#dew-coverage').inputValue()), 35);
    assert.equal(Number(await page.locator('#dew-smallest').inputValue()), 0.3);
});

studio('drawing and dew do not disturb each other', kDesktop, async (page) => {
    await drawThrough(page.mouse, await page.locator('#sheet').boundingBox(), [0.3, 0.5], [0.7, 0.5]);
    await page.locator('#modes [value=dew]').check({ force: true });
    await stateOfDew(page, 'empty');
    assert.equal(await page.locator('#desk').isVisible(), false);
    assert.equal(await page.locator('#undo').isDisabled(), true);
    await page.locator('#dew-bottle').click();
    await stateOfDew(page, 'ready');
    assert.match(await result(page), /droplets, .* on \d+ %/);
    await page.keyboard.press('b');  // a tool's key does nothing here
    await page.locator('#modes [value=draw]').check({ force: true });
    await page.waitForFunction(() => document.documentElement.dataset.droplets === 'ready');
    assert.match(await result(page), /of water, .* high$/);
    assert.match(await page.locator('#command-line').textContent(), /with the footprint saved as PNG/);
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => document.getElementById('result').textContent === '');
    await page.locator('#modes [value=dew]').check({ force: true });
    await stateOfDew(page, 'ready');
    assert.match(await result(page), /droplets, .* on \d+ %/);
});

studio('what is no mesh, or has no place for droplets, is said, and the next object is taken', kDesktop, async (page) => {
    await dropFiles(page, '#sheet', ['broken.glb', '', Buffer.from('no mesh')]);
    await stateOfDew(page, 'refused');
    assert.match(await result(page), /broken\.glb/);
    assert.equal(await page.locator('#result').evaluate(({ classList }) => classList.contains('refused')), true);
    await dropFiles(page, '#view', ['empty.obj', '', Buffer.from('v 0 0 0\n')]);
    await stateOfDew(page, 'refused');
    await cover(page, ...blue);
    await setValue(page, 'dew-objectSize', 0.1);
    await stateOfDew(page, 'refused');
    await page.locator('#undo').click();
    await stateOfDew(page, 'ready');
    // One that no browser can hold.
    await page.evaluate(() => {
        const data = new DataTransfer();
        const file = new File(['v'], 'huge.stl');
        Object.defineProperty(file, 'size', { value: 2 ** 31 });
        Object.defineProperty(data, 'files', { value: [file] });
        const event = new DragEvent('drop', { bubbles: true, cancelable: true });
        Object.defineProperty(event, 'dataTransfer', { value: data });
        document.getElementById('view').dispatchEvent(event);
    });
    await page.waitForFunction(() => !document.getElementById('trouble').hidden);
    assert.match(await page.locator('#trouble').textContent(), /huge\.stl cannot be opened: it has 2048 MB/);
    assert.match(await result(page), /droplets/);
});

studio('the object comes back when the page is loaded again', kDesktop, async (page) => {
    await cover(page, ...blue);
    await page.locator('#dew-kinds [value=shower]').check({ force: true });
    await stateOfDew(page, 'ready');
    const before = await result(page);
    await page.waitForTimeout(800);
    await page.reload();
    await started(page);
    await stateOfDew(page, 'ready');
    assert.equal(await result(page), before);
    assert.equal(await page.locator('#dew-kinds [value=shower]').isChecked(), true);
    await page.locator('#new').click();
    await stateOfDew(page, 'empty');
    await page.locator('#undo').click();
    await stateOfDew(page, 'ready');
});

studio('a .gltf finds the files that it names', kDesktop, async (page) => {
    const corners = new Float32Array([0, 0, 0, 0.04, 0, 0, 0.04, 0, -0.04, 0, 0, -0.04]);
    const buffer = Buffer.concat([Buffer.from(corners.buffer), Buffer.from(new Uint16Array([0, 1, 2, 0, 2, 3]).buffer)]);
    const gltf = {
        asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
        buffers: [{ uri: 'parts/plate%201.bin', byteLength: buffer.length }],
        bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 12 }],
        accessors: [{ bufferView: 0, componentType: 5126, count: 4, type: 'VEC3', min: [0, 0, -0.04], max: [0.04, 0, 0] },
            { bufferView: 1, componentType: 5123, count: 6, type: 'SCALAR' }],
        meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    };
    await dropFiles(page, '#view', ['plate 1.bin', '', buffer], ['plate.gltf', '', Buffer.from(JSON.stringify(gltf))]);
    await stateOfDew(page, 'ready');
    assert.match(await page.locator('#dew-object').textContent(), /^2 triangles, 40\.0\smm × 0\smm × 40\.0\smm$/);
});

studio('on a phone dew is a part like the others, and its controls are reached with a finger', kPhone, async (page) => {
    await page.locator('#tabs [data-part=dew]').tap();
    await stateOfDew(page, 'empty');
    await page.locator('#dew-bottle').tap();
    await stateOfDew(page, 'ready');
    assert.equal(await page.evaluate(() => Math.max(document.documentElement.scrollWidth, document.body.scrollWidth) - innerWidth), 0);
    const small = await page.evaluate(() => [...document.querySelectorAll('button, select, input:not([type=range]), summary')]
        .filter((control) => control.checkVisibility() && !control.closest('#swatches'))
        .map((control) => [control.id || control.outerHTML.slice(0, 60), (control.closest('label') ?? control).getBoundingClientRect()])
        .filter(([, { width, height }]) => Math.min(width, height) < 39.5).map(([id, { width, height }]) => `${id}: ${width} × ${height}`));
    assert.deepEqual(small, []);
    await page.locator('#tabs [data-part=liquid]').tap();
    assert.equal(await page.locator('#liquid').isVisible(), true);
    assert.equal(await page.locator('#dew-fields').isVisible(), false);
});

studio('keys reach every control of dew', kDesktop, async (page) => {
    await page.locator('#modes [value=draw]').focus();
    await page.keyboard.press('ArrowRight');
    await stateOfDew(page, 'empty');
    await page.locator('#dew-bottle').focus();
    await page.keyboard.press('Enter');
    await stateOfDew(page, 'ready');
    const nameless = await page.evaluate(() => [...document.querySelectorAll('input, button, select, canvas, summary')]
        .filter((control) => !(control.labels?.length || control.getAttribute('aria-label') || control.textContent.trim())).map(({ outerHTML }) => outerHTML));
    assert.deepEqual(nameless, []);
    const reached = new Set();
    for (let i = 0; i < 30; ++i) {
        await page.keyboard.press('Tab');
        reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.name));
    }
    for (const id of ['dew-kind', 'dew-objectSize', 'dew-coverage', 'dew-where', 'dew-again', 'ground', 'reset']) {
        assert.ok(reached.has(id), `${id} is not reached: ${[...reached]}`);
    }
});
