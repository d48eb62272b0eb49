// SPDX-License-Identifier: GPL-3.0-or-later
// Installs the packed npm package in an empty folder, uses its command as its users do, and compares it with the native one:
// PROGRAM=… PACKAGE=… node --test command_test.mjs
import assert from 'node:assert/strict';
import { execFileSync, spawn, spawnSync } from 'node:child_process';
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, beforeEach, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../', import.meta.url));
const data = (name) => resolve(root, 'data', name);
// Spaces and letters beyond ASCII, of which paths are full.
const folder = mkdtempSync(join(tmpdir(), 'drop let ü-'));
after(() => rmSync(folder, { recursive: true }));

const npm = (words, cwd) => execFileSync('npm', [...words, '--silent', '--no-audit', '--no-fund'], { cwd, encoding: 'utf8' });
const archive = npm(['pack', process.env.PACKAGE], folder).trim();
const user = join(folder, 'größe und brot');
mkdirSync(user);
writeFileSync(join(user, 'package.json'), '{"private": true}');
npm(['install', join(folder, archive)], user);
const bin = join(user, 'node_modules/.bin/droplet-shape');
// A node whose path has a space, too.
const node = join(folder, 'no de');
symlinkSync(process.execPath, node);

let cwd;
let runs = 0;
beforeEach(() => {
    cwd = join(folder, `run ${++runs}`);
    mkdirSync(cwd);
});

const run = (words, given = {}) => spawnSync(node, [bin, ...words], { cwd, maxBuffer: 1 << 28, ...given });
const native = (words, given = {}) => spawnSync(process.env.PROGRAM, words, { cwd, maxBuffer: 1 << 28, ...given });
function made(words, given) {
    const { status, stderr, stdout } = run(words, given);
    assert.equal(status, 0, `${stderr}`);
    return stdout;
}
const bytes = (name) => readFileSync(join(cwd, name));
const json = (name) => JSON.parse(bytes(name));
const volume = (report) => report.droplets.reduce((sum, droplet) => sum + droplet.volume_m3, 0);
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance * Math.max(Math.abs(a), Math.abs(b));

/** Whether values of JSON are the same, but for the last digits of numbers. */
const close = (a, b) => (typeof a === 'number' ? assert.ok(near(a, b, 1e-9) || Math.abs(a - b) < 1e-12, `${a}, not ${b}`)
    : a && typeof a === 'object' ? assert.deepEqual(Object.keys(a), Object.keys(b)) ?? Object.keys(a).forEach((key) => close(a[key], b[key]))
        : assert.equal(a, b));

test('a logo becomes the GLB that the module makes', async () => {
    made([data('ampersand.png'), 'out.glb', '--width', '3cm', '--quiet']);
    const { makeDroplet } = await import(join(user, 'node_modules/droplet-shape/index.js'));
    assert.deepEqual(bytes('out.glb'), Buffer.from(makeDroplet(new Uint8Array(readFileSync(data('ampersand.png'))), { width: '3cm' })));
    assert.deepEqual(readdirSync(cwd), ['out.glb']);
});

// Drawings are those of resvg here and of librsvg there, which differ in the grey of edges; the circles of the ring end in
// tips, whose angles are sensitive to it.
for (const [name, tolerance] of [['flourish.png', 1e-9], ['handprint.jpg', 1e-9], ['sakura.tif', 1e-9], ['shamrock.webp', 1e-9], ['deer.bmp', 1e-6],
    ['maze.pgm', 1e-9], ['badge.svg', 1e-3], ['ring.svg', 2e-3]]) {
    test(`${name} has the native command's volume`, () => {
        const words = [data(name), 'out.stl', '--model', 'linear', '--json', 'report.json', '--quiet'];
        made(words);
        const here = json('report.json');
        assert.equal(native(words).status, 0);
        const there = json('report.json');
        assert.ok(near(volume(here), volume(there), tolerance), `${volume(here)}, not ${volume(there)}`);
        for (const key of ['width_px', 'height_px', 'pixel_size_m', 'channel', 'inverted']) {
            assert.deepEqual(here.input[key], there.input[key], key);
        }
    });
}

test('text along a path is drawn, and what is not drawn is said', () => {
    const svg = (family, text) => writeFileSync(join(cwd, 'text.svg'), `<svg xmlns="http://www.w3.org/2000/svg" width="6cm" viewBox="0 0 600 300">
        <path id="p" fill="none" d="M50 200Q300 20 550 200"/><text font-family="${family}" font-size="90">${text}</text></svg>`);
    svg('DejaVu Sans', '<textPath href="#p">Drops</textPath>');
    made(['text.svg', 'out.glb', '--json', 'report.json', '--quiet']);
    assert.equal(json('report.json').droplets.length, 5);
    assert.equal(json('report.json').input.physical_width_m ?? 0.06, 0.06);
    svg('No Such Font, serif', '<tspan x="20" y="150">Drop</tspan>');
    assert.match(`${run(['text.svg', 'out.glb']).stderr}`, /not drawn as they are meant: the font 'No Such Font', for which another is used \(.*\)\n$/);
});

// Pages as SVG 2 and CSS allow them, some of which resvg takes for others.
const circle = '<circle cx="100" cy="100" r="60"/>';
const svg = (attributes, content = circle) => `<svg xmlns="http://www.w3.org/2000/svg" ${attributes}>${content}</svg>`;
for (const [name, drawing] of Object.entries({
    'a tag in a comment': `<!-- <svg width="10mm"> -->${svg('width="40mm" viewBox="0 0 200 200"')}`,
    'a prefix': '<s:svg xmlns:s="http://www.w3.org/2000/svg" width="40mm" viewBox="0 0 200 200"><s:circle cx="100" cy="100" r="60"/></s:svg>',
    'a bracket in an attribute and a unit in capitals': svg('aria-label="a > b" width="40MM" viewBox="0 0 200 200"'),
    'exponents, signs and spaces': svg('width=" 4e1mm " height="+40mm" viewBox="0 0 200 200"'),
    'a height alone': svg('height="40mm" viewBox="0 0 200 200"'),
    'pixels beside millimetres': svg('width="40px" height="40mm" viewBox="0 0 200 200"'),
    'no size at all': svg(''),
    percentages: svg('width="100%" height="100%" viewBox="0 0 200 200"'),
    'what is not drawn': svg('width="4cm" viewBox="0 0 200 200"', `${circle}<foreignObject/><image href="a.png" width="1" height="1"/>`),
    'a shorthand of fonts': svg('width="4cm" viewBox="0 0 200 100"', '<text x="10" y="60" style="font:bold 60px DejaVu Sans">Drop</text>'),
    'quotes in an attribute': svg('width="4cm" viewBox="0 0 200 100"',
        '<text x="10" y="60" style="font-family:&quot;No Such&quot;, &quot;DejaVu Sans&quot;;font-size:60px">Drop</text>'),
})) {
    test(`an SVG with ${name} has the native command's page, volume and warnings`, () => {
        writeFileSync(join(cwd, 'in.svg'), drawing);
        const words = ['in.svg', 'out.stl', '--model', 'linear', '--triangles', '5k', '--json', 'report.json', '--quiet'];
        made(words);
        const here = json('report.json');
        assert.equal(native(words).status, 0);
        const there = json('report.json');
        const pixels = ({ input }) => [input.width_px, input.height_px];
        assert.deepEqual(pixels(here), pixels(there));
        assert.ok(near(here.input.pixel_size_m, there.input.pixel_size_m, 1e-12));
        assert.ok(near(volume(here), volume(there), 1e-2), `${volume(here)}, not ${volume(there)}`);
        assert.deepEqual(here.warnings, there.warnings);
    });
}

test('an SVG in UTF-16 is read', () => {
    writeFileSync(join(cwd, 'in.svg'), Buffer.from(`\ufeff<?xml version="1.0" encoding="UTF-16"?>${svg('width="4cm" viewBox="0 0 200 200"')}`, 'utf16le'));
    made(['in.svg', 'out.stl', '--triangles', '2k', '--quiet']);
});

test('every format is what its extension says', () => {
    const begins = { glb: 'glTF', gltf: '{', obj: '#', ply: 'ply', stl: '', usda: '#usda', usdz: 'PK', '3mf': 'PK' };
    for (const [format, start] of Object.entries(begins)) {
        made([data('flourish.png'), `out.${format}`, '--triangles', '3000', '--quiet']);
        assert.ok(bytes(`out.${format}`).toString('latin1').startsWith(start), format);
    }
    assert.ok(existsSync(join(cwd, 'out.mtl')));
});

test('streams are pipes', () => {
    const stl = made(['-', '-', '--format', 'stl', '--triangles', '2000', '--quiet'], { input: readFileSync(data('flourish.png')) });
    made([data('flourish.png'), 'out.stl', '--triangles', '2000', '--quiet']);
    assert.deepEqual(stl, bytes('out.stl'));
});

test('refusals are those of the native command, in words and codes', () => {
    writeFileSync(join(cwd, 'cut.png'), readFileSync(data('ampersand.png')).subarray(0, 2000));
    writeFileSync(join(cwd, 'no.txt'), 'text');
    for (const words of [[], ['--help'], ['--version'], ['batch', '--help'], ['--help=json'], [data('ampersand.png')], [data('ampersand.png'), 'out.dwg'],
        [data('ampersand.png'), 'out.glb', '--contact-angle', '200deg'], ['cut.png', 'out.glb'], ['no.txt', 'out.glb'], ['missing.png', 'out.glb'],
        [data('ampersand.png'), 'no folder/out.glb'], ['anmate', 'x'], [data('ampersand.png'), data('ampersand.png')], ['.', 'out.glb'],
        ['batch', 'no folder', '-o', 'a.glb'], ['compare', 'a.stl', 'b.stl'], ['dew'], ['dew', '--help'], ['dew', '--help=json'], ['dew', 'missing.glb', 'out.glb'],
        ['dew', data('can.glb'), 'out.3mf'], ['dew', data('can.glb'), 'out.glb', '--coverage', '0.8'], ['dew', 'no.txt', 'out.glb'],
        ['dew', data('can.glb'), 'out.obj', '--instancing', 'gpu'], ['dew', data('can.glb'), data('can.glb')],
        ['dew', data('can.glb'), 'no folder/out.glb', '--object-size', '3cm', '-q'],
        ['dew', data('can.glb'), 'out.glb', '--object-size', '3cm', '--vertex-weights'],
        ['dew', data('can.glb'), 'out.glb', '--object-size', '3cm', '--smallest', '15mm']]) {
        const [here, there] = [run(words), native(words)];
        assert.equal(here.status, there.status, words.join(' '));
        assert.equal(`${here.stdout}`, `${there.stdout}`, words.join(' '));
        assert.equal(`${here.stderr}`, `${there.stderr}`, words.join(' '));
    }
    assert.deepEqual(readdirSync(cwd).sort(), ['cut.png', 'manifest.json', 'no.txt']);
});

test('what is not in the package says who has it', () => {
    for (const words of [['glyphs', 'a'], ['flow', 'a'], ['windshield', 'a'], ['morph', 'a', 'b']]) {
        const { status, stderr } = run(words);
        assert.equal(status, 2);
        assert.match(`${stderr}`, /^droplet-shape: .*the droplet-shape for Linux has it.*\n$/);
    }
    for (const option of [['--preview', 'a.png'], ['--turntable', '12', '--preview', 'a.png']]) {
        assert.match(`${run([data('flourish.png'), 'out.glb', ...option]).stderr}`, /needs the ray tracer/);
    }
    writeFileSync(join(cwd, 'film.mp4'), '');
    assert.match(`${run(['animate', 'film.mp4', 'out.glb']).stderr}`, /the program ff[a-z]+/);
    assert.deepEqual(readdirSync(cwd), ['film.mp4']);
});

test('an existing file stays, or is replaced as a whole', () => {
    const words = [data('flourish.png'), 'out.glb', '--triangles', '1000', '--quiet'];
    made([...words, '--no-clobber']);
    const before = bytes('out.glb');
    assert.equal(run([...words, '--no-clobber']).status, 4);
    made(words);
    assert.deepEqual(bytes('out.glb'), before);
    assert.deepEqual(readdirSync(cwd), ['out.glb']);
});

test('batch makes what can be made, and its manifest says the rest', () => {
    mkdirSync(join(cwd, 'in/süß'), { recursive: true });
    for (const [from, to] of [['flourish.png', 'a b.png'], ['handprint.jpg', 'süß/hand.jpg'], ['badge.svg', 'badge.svg'], ['label.png', 'label.png']]) {
        copyFileSync(data(from), join(cwd, 'in', to));
    }
    const words = ['batch', 'in', '--recursive', '-o', 'out/{dir}/{stem}.glb', '--keep-going', '--triangles', '2000', '--quiet'];
    const first = run(words);
    assert.equal(first.status, 6, `${first.stderr}`);
    const rows = json('out/manifest.json').items;
    assert.deepEqual(rows.map(({ status }) => status).sort(), ['failed', 'made', 'made', 'made']);
    assert.match(rows.find(({ status }) => status === 'failed').error, /no liquid in the mask/);
    assert.ok(statSync(join(cwd, 'out/süß/hand.glb')).size > 10000);
    assert.equal(run(words).status, 6);
    assert.deepEqual(json('out/manifest.json').items.map(({ status }) => status).sort(), ['failed', 'skipped', 'skipped', 'skipped']);
});

test('surfaces are compared as natively', () => {
    made([data('flourish.png'), 'a.stl', '--triangles', '3000', '--quiet']);
    made([data('flourish.png'), 'b.ply', '--triangles', '6000', '--quiet']);
    const words = ['compare', 'a.stl', 'b.ply', '--json', 'difference.json', '--quiet'];
    assert.equal(run(words).status, native(words).status);
    native(words);
    const there = json('difference.json');
    run(words);
    close(json('difference.json'), there);
});

// Objects in every format that dew reads, with what it takes from them.
function objects() {
    writeFileSync(join(cwd, 'plate.obj'), 'mtllib plate.mtl\nv 0 0 0\nv 40 0 0\nv 40 10 -40\nv 0 10 -40\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n' +
        'usemtl red\nf 1/1 2/2 3/3 4/4\n');
    writeFileSync(join(cwd, 'plate.mtl'), 'newmtl red\nKd 1 0 0\nmap_Kd label.png\n');
    copyFileSync(data('label.png'), join(cwd, 'label.png'));
    writeFileSync(join(cwd, 'weights.ply'), 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n' +
        'property float weight\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n' +
        '0 0 0 0\n.04 0 0 1\n.04 .04 .01 1\n0 .04 .01 0\n4 0 1 2 3\n');
}

for (const words of [
    ['{data}/can.glb', 'out.glb', '--preset', 'bottle', '--object-size', '6cm', '--droplets', 'drops.csv'],
    ['{data}/can.glb', 'out.glb', '--preset', 'rain', '--from', '1,2,0', '--object-size', '8cm', '--droplets', 'drops.json', '--instancing', 'gpu'],
    ['{data}/can.glb', 'out.usdz', '--preset', 'mist', '--object-size', '3cm', '--instancing', 'nodes', '--detail', 'low', '--droplets-only'],
    ['{data}/can.glb', 'out.glb', '--preset', 'shower', '--object-size', '9cm', '--contact-angle', '35deg', '--compress', 'meshopt'],
    ['plate.obj', 'out.gltf', '--mask', '{data}/ampersand.png', '--smallest', '0.3mm', '--droplets', 'drops.csv'],
    ['plate.obj', 'out.obj', '--preset', 'rain', '--liquid', 'honey', '--seed', '5'],
    ['weights.ply', 'out.ply', '--vertex-weights', '--smallest', '0.4mm', '--detail', 'high', '--droplets', 'drops.csv'],
    ['dry.stl', 'out.stl', '--preset', 'dew', '--object-size', '20mm', '--gravity-direction', '0,0,-1'],
]) {
    test(`dew ${words.join(' ')} has the droplets of the native command`, () => {
        objects();
        assert.equal(native([data('flourish.png'), 'dry.stl', '--model', 'linear', '--triangles', '500', '-q']).status, 0);
        const given = ['dew', ...words.map((word) => word.replace('{data}', data(''))), '--json', 'report.json'];
        const [here, there] = [run, native].map((program) => {
            const { status, stderr } = program(given);
            assert.equal(status, 0, `${stderr}`);
            const { time_s, peak_memory_bytes, ...report } = json('report.json');
            const files = readdirSync(cwd).filter((name) => /^(out|drops)/.test(name)).sort();
            return { said: `${stderr}`, report, files: new Map(files.map((name) => [name, bytes(name)])) };
        });
        assert.equal(here.said, there.said);
        close(here.report, there.report);
        assert.deepEqual([...here.files.keys()], [...there.files.keys()]);
        for (const [name, content] of there.files) {
            if (name.startsWith('drops')) {
                const numbers = (text) => `${text}`.split(/[\s,[\]]+/).map((word) => (Number.isFinite(Number(word)) ? Number(word) : word));
                close(numbers(here.files.get(name)), numbers(content));
            } else {
                assert.ok(near(here.files.get(name).length, content.length, 2e-3), `${name}: ${here.files.get(name).length}, not ${content.length}`);
            }
        }
        const [surface] = [...there.files.keys()].filter((name) => /\.(obj|ply|stl)$/.test(name));
        if (surface) {
            writeFileSync(join(cwd, `here.${surface}`), here.files.get(surface));
            writeFileSync(join(cwd, surface), there.files.get(surface));
            assert.equal(native(['compare', `here.${surface}`, surface, '--tolerance', '0.1mm', '-q']).status, 0);
        }
    });
}

test('frames become an animation', () => {
    made(['animate', data('closing/*.png').replace('*', '0001'), data('closing/0002.png'), 'out.glb', '--triangles', '2000', '--quiet']);
    assert.ok(bytes('out.glb').toString('latin1').startsWith('glTF'));
});

test('the page and Studio are written', () => {
    made([data('flourish.png'), 'out.glb', '--html', 'page.html', '--triangles', '1000', '--quiet']);
    assert.match(bytes('page.html').toString(), /^<!DOCTYPE html>/i);
    made(['studio', 'studio.html']);
    assert.match(bytes('studio.html').toString(), /<script id="solver" type="text\/plain">[A-Za-z0-9+/]{500000}/);
    const display = { ...process.env };
    for (const name of ['DISPLAY', 'WAYLAND_DISPLAY', 'BROWSER']) {
        delete display[name];
    }
    assert.equal(run(['studio'], { env: display }).status, 4);
});

/** Starts a run, and resolves when a line of its standard error has a text. */
function begun(words, text, input = 'ignore') {
    const child = spawn(node, [bin, ...words], { cwd, stdio: [input, 'pipe', 'pipe'] });
    if (text === '') {
        return Promise.resolve({ child, ended: new Promise((end) => void child.on('exit', (code, signal) => end({ code, signal }))) });
    }
    return new Promise((fulfil, reject) => {
        let said = '';
        const ended = new Promise((end) => void child.on('exit', (code, signal) => end({ code, signal, said: () => said })));
        child.stderr.on('data', (part) => {
            said += part;
            if (said.includes(text)) {
                fulfil({ child, ended });
            }
        });
        ended.then(() => reject(new Error(said)));
    });
}

test('a signal ends it, and leaves no unfinished file', async () => {
    const { child, ended } = await begun([data('butterfly.jpg'), 'out.glb', '--triangles', '400000', '--progress', 'json'], '"solve"');
    child.kill('SIGTERM');
    assert.equal((await ended).signal, 'SIGTERM');
    assert.deepEqual(readdirSync(cwd), []);
});

test('a signal leaves the unfinished files of another run', async () => {
    const { child, ended } = await begun(['-', 'out.glb', '--progress', 'json'], '', 'pipe');
    writeFileSync(join(cwd, '.droplet-shape-42-0.tmp'), 'of another run');
    child.stdin.end(readFileSync(data('ampersand.png')));
    await new Promise((go) => void setTimeout(go, 600));
    child.kill('SIGTERM');
    await ended;
    assert.equal(bytes('.droplet-shape-42-0.tmp').toString(), 'of another run');
});

test('a batch that is interrupted ends its item and writes its manifest', async () => {
    mkdirSync(join(cwd, 'in'));
    for (let k = 0; k < 30; ++k) {
        copyFileSync(data('ampersand.png'), join(cwd, `in/${k}.png`));
    }
    const { child, ended } = await begun(['batch', 'in', '-o', 'out/{stem}.glb', '--progress', 'json'], '\n');
    child.kill('SIGINT');
    assert.equal((await ended).signal, 'SIGINT');
    const statuses = json('out/manifest.json').items.map(({ status }) => status);
    assert.ok(statuses.includes('made') && statuses.includes('not started'), `${new Set(statuses)}`);
    assert.equal(readdirSync(join(cwd, 'out')).filter((name) => name.endsWith('.glb')).length, statuses.filter((status) => status === 'made').length);
});

test('--watch makes the droplet again when the picture is saved', async () => {
    copyFileSync(data('flourish.png'), join(cwd, 'in.png'));
    const { child, ended } = await begun(['in.png', 'out.glb', '--watch', '--triangles', '1000'], 'written');
    const before = bytes('out.glb');
    copyFileSync(data('ampersand.png'), join(cwd, 'in.png'));
    for (let wait = 0; wait < 100 && bytes('out.glb').equals(before); ++wait) {
        await new Promise((go) => void setTimeout(go, 100));
    }
    assert.notDeepEqual(bytes('out.glb'), before);
    child.kill('SIGINT');
    assert.equal((await ended).signal, 'SIGINT');
});

test('the package is small', () => {
    const kMost = 8e6;
    assert.ok(statSync(join(folder, archive)).size < kMost);
});
