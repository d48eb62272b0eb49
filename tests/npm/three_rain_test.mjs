// SPDX-License-Identifier: GPL-3.0-or-later
// examples/three/rain.html in a browser: PACKAGE=… THREE=… PLAYWRIGHT=… node --test three_rain_test.mjs
// THREE and PLAYWRIGHT are the folders of three.js and of playwright-core; CHROMIUM the browser.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const { PACKAGE, THREE, PLAYWRIGHT, CHROMIUM = '/usr/bin/chromium' } = process.env;
const { chromium } = createRequire(import.meta.url)(PLAYWRIGHT);
const root = fileURLToPath(new URL('../../', import.meta.url));

/** File of a path that the page asks for. */
function fileOf(path) {
    const folders = { '/node_modules/three/': THREE, '/node_modules/droplet-shape/': PACKAGE };
    for (const [begin, folder] of Object.entries(folders)) {
        if (path.startsWith(begin)) {
            return join(folder, path.slice(begin.length));
        }
    }
    return join(root, { '/': 'examples/three/rain.html', '/rain.glsl': 'src/rain/rain.glsl', '/road.jpg': 'data/raindrops.jpg' }[path]
        ?? `examples/three${path}`);
}

test('rain falls on the glass of three.js', async () => {
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
        const types = { js: 'text/javascript', html: 'text/html', wasm: 'application/wasm' };
        await page.route('**', (route) => {
            const { pathname } = new URL(route.request().url());
            if (pathname === '/favicon.ico') {
                return route.fulfill({ status: 204 });
            }
            const file = fileOf(pathname);
            return route.fulfill({ body: readFileSync(file), contentType: types[file.split('.').pop()] ?? 'application/octet-stream' });
        });
        await page.goto('http://rain.test/');
        await page.waitForFunction(() => document.documentElement.dataset.state === 'drawn');
        const pictures = [await page.screenshot()];
        await page.waitForTimeout(4000);
        pictures.push(await page.screenshot());
        assert.deepEqual(complaints, []);
        // The mean of all levels: the picture is seen, and the water changes it.
        const levels = pictures.map((png) => execFileSync('ffmpeg', ['-v', 'error', '-f', 'png_pipe', '-i', '-', '-f', 'rawvideo', '-pix_fmt', 'gray', '-'],
            { input: png }));
        assert.ok(levels[1].reduce((a, b) => a + b) / levels[1].length > 10, 'the picture is black');
        const change = levels[0].reduce((sum, level, k) => sum + Math.abs(level - levels[1][k]), 0) / levels[0].length;
        assert.ok(change > 0.3, `${change} levels`);
    } finally {
        await browser.close();
    }
});
