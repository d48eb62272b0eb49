// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of examples/three in a browser: PACKAGE=… THREE=… PLAYWRIGHT=… node --test three_test.mjs
// THREE and PLAYWRIGHT are the folders of three.js and of playwright-core; CHROMIUM the browser.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const { PACKAGE, THREE, PLAYWRIGHT, CHROMIUM = '/usr/bin/chromium' } = process.env;
const { chromium } = createRequire(import.meta.url)(PLAYWRIGHT);
const root = fileURLToPath(new URL('../../', import.meta.url));

const folder = mkdtempSync(join(tmpdir(), 'three-'));
after(() => rmSync(folder, { recursive: true }));

/** File of a path that a page asks for. */
function fileOf(path) {
    const folders = { '/node_modules/three/': THREE, '/node_modules/droplet-shape/': PACKAGE, '/logo': join(folder, 'logo') };
    for (const [begin, files] of Object.entries(folders)) {
        if (path.startsWith(begin)) {
            return files + (begin.endsWith('/') ? '/' : '') + path.slice(begin.length);
        }
    }
    return join(root, { '/rain.glsl': 'src/rain/rain.glsl', '/road.jpg': 'data/raindrops.jpg' }[path] ?? `examples/three${path}`);
}

/** Opens a page in a small window, waits until it has drawn, and calls a function. It must not complain. */
async function opened(name, act) {
    const browser = await chromium.launch({
        executablePath: CHROMIUM, args: ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
            '--ignore-gpu-blocklist', '--disable-background-networking'],
    });
    try {
        const page = await browser.newPage({ viewport: { width: 320, height: 180 } });
        page.setDefaultTimeout(120_000);
        const complaints = [];
        page.on('pageerror', (error) => complaints.push(error.message));
        page.on('console', (message) => {
            if (['error', 'warning'].includes(message.type()) && !/GPU stall|swiftshader|GroupMarkerNotSet/i.test(message.text())) {
                complaints.push(message.text());
            }
        });
        const types = { js: 'text/javascript', html: 'text/html', wasm: 'application/wasm', png: 'image/png', json: 'application/json' };
        await page.route('**', (route) => {
            const { pathname } = new URL(route.request().url());
            if (pathname === '/favicon.ico') {
                return route.fulfill({ status: 204 });
            }
            const file = fileOf(pathname);
            return route.fulfill({ body: readFileSync(file), contentType: types[file.split('.').pop()] ?? 'application/octet-stream' });
        });
        await page.goto(`http://three.test/${name}`);
        await page.waitForFunction(() => document.documentElement.dataset.state === 'drawn');
        await act(page);
        assert.deepEqual(complaints, []);
    } finally {
        await browser.close();
    }
}

/** Grey levels of what the page shows, by rows. */
async function levelsOf(page) {
    return execFileSync('ffmpeg', ['-v', 'error', '-f', 'png_pipe', '-i', '-', '-f', 'rawvideo', '-pix_fmt', 'gray', '-'],
        { input: await page.screenshot() });
}

const mean = (levels) => levels.reduce((a, b) => a + b) / levels.length;

test('rain falls on the glass', () => opened('rain.html', async (page) => {
    const before = await levelsOf(page);
    await page.waitForTimeout(4000);
    const now = await levelsOf(page);
    // The picture is seen, and the water changes it.
    assert.ok(mean(now) > 10, 'the picture is black');
    const change = mean(before.map((level, k) => Math.abs(level - now[k])));
    assert.ok(change > 0.3, `${change} levels`);
}));

test('maps of droplets are water on a wall', async () => {
    const out = (name) => join(folder, name);
    execFileSync('node', [join(PACKAGE, 'command.js'), join(root, 'data/ampersand.png'), out('logo.glb'), '--width', '6cm', '--maps', out('logo.png'),
        '--json', out('logo.json'), '-q']);
    await opened('decal.html', async (page) => {
        await page.waitForTimeout(500);
        const levels = await levelsOf(page);
        const at = (x, y) => levels[320 * y + x];
        // Beside the letter is dry wall; in it the wall is damp, and water shines on it.
        assert.ok(at(10, 10) > 60, `${at(10, 10)}`);
        const inner = Array.from(levels).filter((_, k) => Math.abs((k % 320) - 160) < 60 && Math.abs(Math.floor(k / 320) - 90) < 60);
        assert.ok(Math.min(...inner) < 0.75 * at(10, 10), `${Math.min(...inner)}`);
        assert.ok(Math.max(...inner) > 1.2 * at(10, 10), `${Math.max(...inner)}`);
    });
});
