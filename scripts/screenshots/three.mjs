// SPDX-License-Identifier: GPL-3.0-or-later
// Takes a picture of examples/three with a droplet: node three.mjs CHROMIUM PLAYWRIGHT_FOLDER THREE_FOLDER DROPLET_GLB PICTURE_PNG
import { createServer } from 'node:http';
import { readFileSync } from 'node:fs';
import { extname } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const [executablePath, playwright, three, droplet, picture] = process.argv.slice(2);
const { chromium } = await import(pathToFileURL(`${playwright}/index.mjs`));
const example = fileURLToPath(new URL('../../examples/three/', import.meta.url));
const types = { '.html': 'text/html', '.js': 'text/javascript', '.glb': 'model/gltf-binary' };
const server = createServer((request, response) => {
    const path = request.url === '/' ? '/index.html' : request.url;
    const file = path === '/droplet.glb' ? droplet
        : path.startsWith('/node_modules/three/') ? path.replace('/node_modules/three', three) : example + path;
    try {
        const bytes = readFileSync(file);
        response.writeHead(200, { 'Content-Type': types[extname(file)] ?? 'application/octet-stream' }).end(bytes);
    } catch {
        response.writeHead(404).end();
    }
}).listen(0, '127.0.0.1');
const browser = await chromium.launch({
    executablePath,
    args: ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
const page = await browser.newPage({ viewport: { width: 800, height: 600 } });
page.setDefaultTimeout(120_000);
page.on('pageerror', (error) => { throw error; });
await page.goto(`http://127.0.0.1:${server.address().port}/`);
await page.waitForFunction(() => document.documentElement.dataset.state === 'drawn');
await page.screenshot({ path: picture });
await browser.close();
server.close();
