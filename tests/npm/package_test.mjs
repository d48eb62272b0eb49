// SPDX-License-Identifier: GPL-3.0-or-later
// Uses the npm package as its users do, and compares it with the command: PROGRAM=… PACKAGE=… node --test package_test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));
const data = (name) => resolve(root, 'data', name);
const png = (name) => new Uint8Array(readFileSync(data(name)));
const folder = mkdtempSync(join(tmpdir(), 'droplet-npm-'));
after(() => rmSync(folder, { recursive: true }));

const { pngOf } = await import(join(process.env.PACKAGE, 'png.js'));
const { dashed } = await import(join(process.env.PACKAGE, 'droplet_shape.js'));
const { DropletError, dew, dewOptions, makeDroplet, options, readMask, shapeDroplet } = await import(join(process.env.PACKAGE, 'index.js'));

/** Report and bytes of the command for the same options. */
function command(name, given) {
    const output = join(folder, 'droplet.glb');
    const words = Object.entries(given).map(([key, value]) => {
        const option = `--${dashed(key)}`;
        return value === true ? option : `${option}=${value}`;
    });
    const report = execFileSync(process.env.PROGRAM, [data(name), output, '--quiet', '--json', '-', ...words],
        { maxBuffer: 1 << 26 });
    return { report: JSON.parse(report), glb: readFileSync(output) };
}

function disc(size, radius, Pixels = Uint8Array) {
    const full = Pixels === Uint16Array ? 65535 : 255;
    const coverage = Pixels.from({ length: size * size }, (_, k) => {
        const away = Math.hypot((k % size) + 0.5 - size / 2, Math.floor(k / size) + 0.5 - size / 2);
        return Math.round(full * Math.min(Math.max(radius + 0.5 - away, 0), 1));
    });
    return { width: size, height: size, data: coverage };
}

const near = (a, b, tolerance) => a === b || Math.abs(a - b) <= tolerance * Math.max(Math.abs(a), Math.abs(b));

/** The command's figures of every droplet, and the mesh's counts. */
function compareWithCommand(name, given, tolerance) {
    const expected = command(name, given).report;
    const made = shapeDroplet(png(name), given).report;
    assert.equal(made.model, expected.model);
    assert.equal(made.mesh.triangles, expected.mesh.triangles);
    assert.equal(made.output.triangles, expected.output.triangles);
    assert.equal(made.droplets.length, expected.droplets.length);
    for (const [k, droplet] of made.droplets.entries()) {
        for (const figure of ['volume_m3', 'pressure_pa', 'height_max_m', 'footprint_area_m2']) {
            assert.ok(near(droplet[figure], expected.droplets[k][figure], tolerance),
                `${figure} of droplet ${k + 1}: ${droplet[figure]}, not ${expected.droplets[k][figure]}`);
        }
    }
    for (const key of ['width_px', 'height_px', 'pixel_size_m', 'channel', 'inverted', 'segment', 'threshold']) {
        assert.equal(made.input[key], expected.input[key], key);
    }
}

const soft = ['ampersand.png', 'cluster.png', 'debian_astro.png', 'dew.png', 'flourish.png', 'inkscape.png', 'line_of_type.png',
    'ornament.png', 'raindrops.png'];
for (const name of soft) {
    test(`${name} has the command's figures`, () => compareWithCommand(name, { model: 'linear' }, 1e-9));
}
test('a star that the package packs into a PNG has the command’s figures', () => {
    const size = 300;
    const rgba = new Uint8ClampedArray(4 * size * size);
    for (let k = 0; k < size * size; ++k) {
        const x = (k % size) + 0.5 - size / 2;
        const y = Math.floor(k / size) + 0.5 - size / 2;
        const rim = 90 + 30 * Math.cos(5 * Math.atan2(y, x));
        rgba.set([0, 0, 0, Math.round(255 * Math.min(Math.max(rim - Math.hypot(x, y), 0), 1))], 4 * k);
    }
    const name = join(folder, 'star.png');
    writeFileSync(name, pngOf({ width: size, height: size, data: rgba }));
    compareWithCommand(name, { model: 'linear' }, 1e-9);
});
test('the exact model has the command’s figures', () => compareWithCommand('inkscape.png', { model: 'exact' }, 1e-9));
// Its triangles are made anew on the way, where the last bit of a logarithm decides.
test('a sheet nearly has the command’s figures', () => {
    const expected = command('ampersand.png', {}).report;
    const made = shapeDroplet(png('ampersand.png')).report;
    assert.equal(made.model, expected.model);
    assert.ok(near(made.shape.volume_m3, expected.shape.volume_m3, 6e-3), `${made.shape.volume_m3}, not ${expected.shape.volume_m3}`);
    assert.ok(near(made.shape.height_max_m, expected.shape.height_max_m, 2e-3), `${made.shape.height_max_m}, not ${expected.shape.height_max_m}`);
});
test('a JPEG, a WebP and a TIFF are read, too', () => {
    for (const name of ['handprint.jpg', 'shamrock.webp', 'sakura.tif']) {
        compareWithCommand(name, { model: 'linear' }, 1e-9);
    }
});

test('strokes on a photograph give the command’s mask', () => {
    const file = join(folder, 'mask.png');
    const given = { smooth: '0.1mm', fillHoles: '1mm2', invert: true };
    command('raindrops.jpg', { seeds: data('raindrops_seeds.png'), maskOut: file, ...given });
    // With its levels as they are.
    const expected = readMask(new Uint8Array(readFileSync(file)), { channel: 'luma' });
    const made = readMask(png('raindrops.jpg'), { seeds: png('raindrops_seeds.png'), ...given });
    assert.deepEqual([made.width, made.height, made.data.length], [750, 800, 750 * 800]);
    // The last bits of exponentials differ between C libraries.
    assert.ok(made.data.every((level, k) => Math.abs(level - expected.data[k]) <= 16));
});
test('a droplet of marked drops has the command’s figures', () => {
    const expected = command('raindrops.jpg', { seeds: data('raindrops_seeds.png'), model: 'linear' }).report;
    const made = shapeDroplet(png('raindrops.jpg'), { seeds: png('raindrops_seeds.png'), model: 'linear' }).report;
    assert.equal(made.input.segment, 'seeds');
    assert.equal(made.droplets.length, expected.droplets.length);
    assert.ok(near(made.shape.volume_m3, expected.shape.volume_m3, 1e-6), `${made.shape.volume_m3}, not ${expected.shape.volume_m3}`);
});
test('strokes are refused that are no picture, have another size or lack a kind', () => {
    const photo = png('raindrops.jpg');
    const strokes = (size, ...greys) => {
        const rgba = new Uint8ClampedArray(4 * size ** 2);
        greys.forEach((grey, k) => rgba.set([grey, grey, grey, 255], 4 * k));
        return { width: size, height: size, data: rgba };
    };
    const square = { width: 8, height: 8, data: Uint8ClampedArray.from({ length: 256 }, (_, k) => (k % 4 === 3 ? 255 : k)) };
    for (const [picture, seeds, code, message] of [
        [photo, 'strokes.png', 'InvalidArgument', /^seeds: 'strokes\.png' must be the bytes of a picture/],
        [photo, disc(8, 3), 'InvalidArgument', /^seeds: must be the bytes of a picture, or pixels of RGBA/],
        [photo, strokes(8, 0, 255), 'InvalidInput', /^seeds: it has 8 x 8 pixels, must be 750 x 800/],
        [square, strokes(8, 0), 'InvalidInput', /must have a light stroke/],
        [square, strokes(8, 255), 'InvalidInput', /must have a dark stroke/],
        [disc(8, 3), strokes(8, 0, 255), 'InvalidArgument', /^seeds needs a picture, not coverage/],
    ]) {
        assert.throws(() => readMask(picture, { seeds }), (error) => error instanceof DropletError && error.code === code && message.test(error.message));
    }
    assert.throws(() => readMask(photo, { seeds: strokes(8, 0, 255), colour: 'red' }), { code: 'InvalidArgument' });
});

test('droplets are laid on an object as by the command', () => {
    const size = 400;
    const rgba = new Uint8ClampedArray(4 * size ** 2);
    for (let k = 0; k < size ** 2; ++k) {
        const [x, y] = [k % size, Math.floor(k / size)];
        rgba[4 * k + 3] = Math.hypot(x - 120, y - 110) < 30 || Math.hypot(x - 300, y - 110) < 20 || Math.hypot(x - 200, y - 230) < 15 ? 255 : 0;
    }
    const name = join(folder, 'dots.png');
    writeFileSync(name, pngOf({ width: size, height: size, data: rgba }));
    const { report: expected, glb } = command(name, { onto: data('can.glb') });
    const can = { name: 'can.glb', data: png('can.glb') };
    const made = shapeDroplet({ width: size, height: size, data: rgba }, { onto: can });
    assert.equal(expected.onto.droplets_laid, 2);
    for (const [key, value] of Object.entries(expected.onto).filter(([, figure]) => typeof figure === 'number')) {
        assert.ok(near(made.report.onto[key], value, 1e-6), `${key}: ${made.report.onto[key]}, not ${value}`);
    }
    assert.ok(near(made.report.input.pixel_size_m, expected.input.pixel_size_m, 1e-12));
    assert.ok(near(made.report.shape.volume_m3, expected.shape.volume_m3, 6e-3));
    assert.equal(readMask({ width: size, height: size, data: rgba }, { onto: png('can.glb') }).pixelSize, made.report.input.pixel_size_m);
    // The droplets are at the can, which stands on the ground and is 12 cm high.
    const [low, high] = [0, 1].map((end) => made.surface.positions.reduce((most, value, k) => (k % 3 === 2 ? (end ? Math.max : Math.min)(most, value) : most), end ? -1 : 1));
    assert.ok(low > 0 && high < 0.13 && high - low > 0.01, `${low} to ${high}`);
    // Files have the object with the droplets on it, as those of the command, or the droplets alone.
    const names = (bytes) => {
        const { nodes, materials } = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true))));
        return [nodes, materials].map((list) => list.map((each) => each.name));
    };
    assert.deepEqual(names(made.file('glb')), names(glb));
    assert.deepEqual(names(made.file('glb', { dropletsOnly: true })), [['droplet'], ['water']]);
    assert.deepEqual(names(shapeDroplet({ width: size, height: size, data: rgba }, { onto: can, dropletsOnly: true }).file()), [['droplet'], ['water']]);
    assert.throws(() => made.file('glb', { compress: 'meshopt' }), { code: 'InvalidArgument', message: /^compress: changes more than a file/ });
    assert.throws(() => made.maps(), { code: 'InvalidArgument', message: /^maps and onto exclude each other/ });
    assert.throws(() => shapeDroplet(disc(64, 30), { onto: can }), { code: 'NoSuchDroplet' });
    assert.throws(() => shapeDroplet(disc(64, 8), { onto: { name: 'can.obj', data: can.data } }), { code: 'InvalidArgument' });
    assert.throws(() => shapeDroplet(disc(64, 8), { onto: 'can.glb' }), { code: 'InvalidArgument', message: /^onto: must be the bytes of a \.glb/ });
});

test('maps are those of the command', () => {
    const path = join(folder, 'map.png');
    command('ampersand.png', { maps: path, mapWidth: 128 });
    const maps = shapeDroplet(png('ampersand.png')).maps({ path: 'map.png', mapWidth: 128 });
    const names = ['height', 'normal', 'thickness', 'coverage', 'wetness', 'occlusion'].map((map) => `map-${map}.png`);
    assert.deepEqual(Object.keys(maps), names);
    for (const name of names) {
        const [ours, theirs] = [Buffer.from(maps[name]), readFileSync(join(folder, name))];
        assert.deepEqual(ours.subarray(0, 29), theirs.subarray(0, 29), name);  // size and kind
        assert.ok(Math.abs(ours.length / theirs.length - 1) < 0.02, `${name}: ${ours.length} ${theirs.length}`);
    }
    const droplet = shapeDroplet(disc(64, 20));
    assert.deepEqual(Object.keys(droplet.maps())[0], 'droplet-height.png');
    assert.throws(() => droplet.maps({ path: 'x.exr' }), { code: 'InvalidArgument', message: /must end in \.png/ });
    assert.throws(() => droplet.maps({ mapWidth: 4 }), { code: 'InvalidArgument', message: /^mapWidth: '4' must be/ });
    assert.throws(() => droplet.maps({ width: '1cm' }), { code: 'InvalidArgument', message: /^width: unknown option/ });
});

// The stairs of a mask without grey are faired until the change is small, by logarithms, whose last bits differ between C
// libraries.
for (const name of ['closing/0001.png', 'closing/0006.png', 'closing/0012.png', 'letter_g_1bit.png']) {
    test(`${name}, without grey, nearly has the command's figures`, () => compareWithCommand(name, { model: 'linear' }, 1e-6));
}

test('the surface is closed, and as large as the report says', () => {
    const droplet = shapeDroplet(disc(200, 60), { width: '10mm', volume: '2uL', triangles: 3000 });
    const { positions, normals, uvs, contactAngles, triangles } = droplet.surface;
    assert.equal(positions.length, normals.length);
    assert.equal(2 * positions.length, 3 * uvs.length);
    assert.equal(positions.length, 3 * contactAngles.length);
    assert.equal(triangles.length, 3 * droplet.report.output.triangles);
    const at = (v) => positions.slice(3 * v, 3 * v + 3);
    const edges = new Map();
    const name = (v) => at(v).join();
    let volume = 0;
    for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => at(triangles[t + k]));
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
        for (let k = 0; k < 3; ++k) {
            const edge = `${name(triangles[t + k])} ${name(triangles[t + (k + 1) % 3])}`;
            edges.set(edge, (edges.get(edge) ?? 0) + 1);
        }
    }
    for (const [edge, count] of edges) {
        assert.equal(count, 1);
        assert.ok(edges.has(edge.split(' ').reverse().join(' ')));
    }
    assert.ok(near(volume, 2e-9, 1e-6), `${volume}`);
});

test('pixels, coverage and PNG mean the same droplet', () => {
    const words = disc(256, 90, Uint16Array);
    const bytes = disc(256, 90);
    const rgba = new Uint8ClampedArray(4 * bytes.data.length);
    bytes.data.forEach((level, k) => rgba.set([level, level, level, 255], 4 * k));
    const [one, two, three] = [words, bytes, { ...bytes, data: rgba }].map(
        (mask) => shapeDroplet(mask, { triangles: 2000, model: 'linear' }).report);
    assert.ok(near(one.mesh.footprint_area_m2, two.mesh.footprint_area_m2, 1e-4));
    assert.equal(two.shape.volume_m3, three.shape.volume_m3);
    // A cap of 40 degrees.
    const radius = 90 / 256 * 0.02;
    assert.ok(near(two.mesh.footprint_area_m2, Math.PI * radius ** 2, 2e-3));
});

test('transparent pixels are dry', () => {
    const { data: level, ...size } = disc(128, 40);
    const rgba = new Uint8Array(4 * level.length);
    level.forEach((alpha, k) => rgba.set([200, 30, 10, alpha], 4 * k));
    const { input, mesh } = shapeDroplet({ ...size, data: rgba }, { triangles: 1000 }).report;
    assert.equal(input.channel, 'alpha');
    assert.ok(near(mesh.footprint_area_m2, Math.PI * (40 / 128 * 0.02) ** 2, 5e-3));
});

test('makeDroplet gives the same GLB as the command', () => {
    const given = { model: 'linear', triangles: 4000, width: '30mm' };
    assert.deepEqual(Buffer.from(makeDroplet(png('flourish.png'), given)), command('flourish.png', given).glb);
});

test('every format is written', () => {
    const droplet = shapeDroplet(disc(64, 20), { triangles: 500 });
    const begins = { glb: 'glTF', gltf: '{', obj: '#', ply: 'ply', stl: '', usda: '#usda', usdz: 'PK', '3mf': 'PK' };
    for (const [format, start] of Object.entries(begins)) {
        const bytes = droplet.file(format);
        assert.ok(bytes.length > 1000, format);
        assert.ok(Buffer.from(bytes).toString('latin1').startsWith(start), format);
    }
    assert.throws(() => droplet.file('dwg'), { code: 'InvalidArgument' });
    assert.ok(droplet.file('stl').length > 1000);
});

test('numbers are SI units', () => {
    const mask = disc(100, 30);
    const by = (given) => shapeDroplet(mask, { triangles: 1000, ...given }).report;
    assert.deepEqual(by({ contactAngle: Math.PI / 6, width: 0.01 }).shape.volume_m3, by({ contactAngle: '30deg', width: '10mm' }).shape.volume_m3);
    assert.ok(near(by({ volume: 2e-9 }).shape.volume_m3, 2e-9, 1e-9));
});

test('errors name the option as it was given', () => {
    const mask = disc(100, 30);
    const refused = (given, code, text) => assert.throws(() => shapeDroplet(mask, given), (error) => {
        assert.ok(error instanceof DropletError);
        assert.equal(error.code, code);
        assert.match(error.message, text);
        return true;
    });
    refused({ contactAngle: '200deg' }, 'InvalidArgument', /^contactAngle/);
    refused({ contactAngle: 40 }, 'InvalidArgument', /^contactAngle: .*; a number is in radians: write '40deg'$/);
    refused({ grading: 3 }, 'InvalidArgument', /^grading: '3' must be one of auto, 1, 2/);
    refused({ contact: '20deg' }, 'InvalidArgument', /contact: unknown option/);
    refused({ volume: '3' }, 'InvalidArgument', /volume/);
    refused({ open: 'yes' }, 'InvalidArgument', /true or false/);
    refused({ volume: NaN }, 'InvalidArgument', /finite/);
    refused({ volume: '10L', gravity: '-9.81m/s2', tilt: '0deg' }, 'NoSuchDroplet', /./);
    refused({ surface: 'map.png' }, 'InvalidArgument', /files/);
    assert.throws(() => shapeDroplet({ width: 4, height: 4, data: new Uint8Array(16) }), { code: 'InvalidInput' });
    assert.throws(() => shapeDroplet({ width: 4, height: 4, data: new Uint8Array(15) }), { code: 'InvalidArgument' });
    assert.throws(() => shapeDroplet(new Uint8Array([1, 2, 3])), { code: 'InvalidInput' });
    assert.throws(() => shapeDroplet('logo.png'), { code: 'InvalidArgument', message: /^mask: 'logo.png' .*readFileSync/ });
    // The solver goes on after errors.
    assert.ok(shapeDroplet(mask, { triangles: 500 }).report.shape.volume_m3 > 0);
});

test('a damaged PNG is refused, wherever it ends', () => {
    const whole = png('label.png');
    for (const share of [0.01, 0.3, 0.7, 0.99]) {
        assert.throws(() => shapeDroplet(whole.slice(0, Math.floor(share * whole.length))), { code: 'InvalidInput' });
    }
});

test('freed droplets leave no memory behind', () => {
    const mask = disc(400, 150);
    const memory = () => {
        const droplet = shapeDroplet(mask, { triangles: 10000, model: 'linear' });
        const bytes = droplet.report.peak_memory_bytes;
        droplet.free();
        return bytes;
    };
    memory();
    const before = memory();
    for (let k = 0; k < 50; ++k) {
        memory();
    }
    assert.equal(memory(), before);
    const droplet = shapeDroplet(mask, { triangles: 500 });
    droplet.free();
    assert.throws(() => droplet.report, { code: 'InvalidArgument' });
});

test('options are those of the command', () => {
    for (const [words, known] of [[['--help'], options], [['dew', '--help'], dewOptions]]) {
        const help = execFileSync(process.env.PROGRAM, words).toString();
        assert.ok(known.length > 25);
        for (const { name } of known) {
            assert.ok(help.includes(`--${dashed(name)}`), name);
        }
    }
});

// A square of 4 cm with uv, in millimetres; the right half of the picture is white, which is liquid.
const plate = `mtllib plate.mtl
v 0 0 0\nv 40 0 0\nv 40 0 -40\nv 0 0 -40\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl blue\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n`;
const text = (string) => new TextEncoder().encode(string);
const plateFile = { name: 'plate.obj', data: text(plate), beside: { 'plate.mtl': text('newmtl blue\nKd 0 0 1\n') } };
const half = { width: 16, height: 16, data: Uint8ClampedArray.from({ length: 4 * 256 }, (_, k) => (k % 4 === 3 || (k >> 2) % 16 > 7 ? 255 : 0)) };

test('dew has the droplets of the command', () => {
    const given = { preset: 'rain', objectSize: '6cm', seed: 7 };
    const output = join(folder, 'dew.glb');
    const expected = JSON.parse(execFileSync(process.env.PROGRAM, ['dew', data('can.glb'), output, '--preset', 'rain', '--object-size', '6cm', '--seed',
        '7', '--quiet', '--json', '-']));
    const made = dew(png('can.glb'), given);
    for (const [key, value] of Object.entries(expected.droplets)) {
        assert.ok(near(made.report.droplets[key], value, 1e-9), `${key}: ${made.report.droplets[key]}, not ${value}`);
    }
    assert.ok(near(made.file().length, readFileSync(output).length, 1e-3));
    assert.equal(made.file('csv').filter((byte) => byte === 10).length, 1 + expected.droplets.count);
});

test('the surface of dew is the closed droplets of the report', () => {
    const made = dew(plateFile, { coverage: 0.1, largest: 0.002, smallest: '1mm', gravityDirection: [0, -1, 0] });
    const { positions, normals, triangles } = made.surface;
    assert.equal(positions.length, normals.length);
    let volume = 0;
    for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => positions.slice(3 * triangles[t + k], 3 * triangles[t + k] + 3));
        volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6;
    }
    assert.ok(near(volume, made.report.droplets.volume_m3, 1e-2), `${volume}`);
    for (let v = 0; v < positions.length; v += 3) {
        assert.ok(positions[v] > -0.002 && positions[v] < 0.042 && positions[v + 2] > -1e-6, 'on the plate, z up');
    }
    made.free();
    assert.throws(() => made.file(), { code: 'InvalidArgument' });
});

test('dew reads the files beside an object, and a mask as bytes or pixels', () => {
    const by = (object, mask) => dew(object, { mask, smallest: '0.5mm' });
    const made = by(plateFile, half);
    assert.deepEqual(made.report.warnings, []);
    assert.ok(near(made.report.droplets.area_m2, 0.5 * 0.04 ** 2, 2e-2));
    const { positions } = made.surface;
    for (let v = 0; v < positions.length; v += 3) {
        assert.ok(positions[v] > 0.018);
    }
    assert.deepEqual(by(plateFile, pngOf(half)).file('stl'), made.file('stl'));
    assert.match(by({ ...plateFile, beside: {} }).report.warnings.join(), /plate.mtl/);
});

test('every format of dew is written, and others are refused', () => {
    const made = dew(plateFile, { coverage: 0.05, smallest: '1mm', compress: 'meshopt' });
    const begins = { glb: 'glTF', gltf: '{', usda: '#usda', usdz: 'PK', obj: '#', ply: 'ply', stl: '', csv: 'frame,time_s,id' };
    for (const [format, start] of Object.entries(begins)) {
        const bytes = Buffer.from(made.file(format));
        assert.ok(bytes.length > 1000 && bytes.toString('latin1').startsWith(start), format);
    }
    assert.throws(() => made.file('3mf'), { code: 'InvalidArgument' });
});

test('errors of dew name what was given', () => {
    for (const [object, given, code, message] of [
        [plateFile, { coverage: 0.9 }, 'InvalidArgument', /^coverage: /],
        [plateFile, { smallest: '2mm', largest: '1mm' }, 'InvalidArgument', /^smallest: '2mm' must be at most largest, 1mm/],
        [plateFile, { droplets: 'a.csv' }, 'InvalidArgument', /^droplets: unknown option/],
        [plateFile, { from: [0, 1] }, 'InvalidArgument', /^from: .*three numbers/],
        [plateFile, { from: [0, -1, 0] }, 'InvalidInput', /^plate.obj: the object has no place/],
        [plateFile, { vertexWeights: true }, 'InvalidArgument', /^vertexWeights: /],
        [plateFile, { mask: text('no picture') }, 'InvalidInput', /^mask: not an image/],
        [{ ...plateFile, name: '../plate.obj' }, {}, 'InvalidArgument', /^object: .*without its folder/],
        [{ ...plateFile, name: 'plate.dwg' }, {}, 'InvalidArgument', /^format is 'dwg'/],
        [{ ...plateFile, name: '--help' }, {}, 'InvalidArgument', /^format is ''/],
        ['can.glb', {}, 'InvalidArgument', /^object: /],
        [png('can.glb').slice(0, 5000), {}, 'InvalidInput', /^cannot use object.glb: /],
    ]) {
        assert.throws(() => dew(object, given), (error) => {
            assert.ok(error instanceof DropletError, `${error.stack}`);
            assert.equal(error.code, code, error.message);
            assert.match(error.message, message);
            return true;
        });
    }
    assert.ok(dew(plateFile, { smallest: '1mm' }).report.droplets.count > 0);
});

test('the types are current', () => {
    const made = execFileSync('node', [join(root, 'npm/make_types.mjs'), join(process.env.PACKAGE, 'droplet_shape.wasm')]);
    assert.equal(made.toString(), readFileSync(join(root, 'npm/droplet_shape.d.ts'), 'utf8'));
});

test('npm packs it, and installs the archive elsewhere', () => {
    const npm = (words, cwd) => execFileSync('npm', [...words, '--silent', '--no-audit', '--no-fund'], { cwd, encoding: 'utf8' });
    const user = join(folder, 'user');
    mkdirSync(user);
    const archive = npm(['pack', process.env.PACKAGE], folder).trim();
    writeFileSync(join(user, 'package.json'), '{"private": true}');
    npm(['install', join(folder, archive)], user);
    const installed = readdirSync(join(user, 'node_modules/droplet-shape')).sort();
    assert.deepEqual(installed, readdirSync(process.env.PACKAGE).sort());
    for (const file of ['LICENSE', 'README.md', 'command.js', 'droplet_shape.d.ts', 'droplet_shape.wasm']) {
        assert.ok(installed.includes(file), file);
    }
    writeFileSync(join(user, 'use.mjs'), `import { makeDroplet } from 'droplet-shape';
        process.stdout.write(makeDroplet({ width: 8, height: 8, data: new Uint8Array(64).fill(255, 18, 46) }, { triangles: 300 }).subarray(0, 4));`);
    assert.equal(execFileSync('node', ['use.mjs'], { cwd: user, encoding: 'utf8' }), 'glTF');
    writeFileSync(join(user, 'pour.mjs'), `import { readFileSync } from 'node:fs';
        import { loadLiquid2d } from 'droplet-shape/liquid2d';
        const wasm = readFileSync(new URL(import.meta.resolve('droplet-shape/droplet_liquid.wasm')));
        const liquid = (await loadLiquid2d(wasm)).make({ preset: 'dam', particles: 500 });
        liquid.advance(0.05);
        process.stdout.write(String(liquid.outlines().liquid.length > 0 && liquid.svg('flat', 100).startsWith('<svg')));`);
    assert.equal(execFileSync('node', ['pour.mjs'], { cwd: user, encoding: 'utf8' }), 'true');
});
