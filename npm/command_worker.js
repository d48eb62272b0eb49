// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the command in a thread: loads the module with node's files, and whatever needs more of the system.
import fs from 'node:fs';
import { spawn } from 'node:child_process';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parentPort, workerData } from 'node:worker_threads';
import { instantiate } from './droplet_shape.js';
import { studioPage } from './studio_page.js';
import { svgDrawer } from './svg.js';
import { nodeSystem, posixPath } from './system.js';

const here = (name) => new URL(name, import.meta.url);

/** Shows a page in the browser; whether a program for that was started. */
function openPage(content) {
    const page = join(fs.mkdtempSync(join(tmpdir(), 'droplet-shape-')), 'studio.html');
    fs.writeFileSync(page, content);
    const [program, ...words] = process.platform === 'win32' ? ['cmd', '/c', 'start', '', page]
        : process.platform === 'darwin' ? ['open', page] : ['xdg-open', page];
    if (process.platform === 'linux' && !process.env.DISPLAY && !process.env.WAYLAND_DISPLAY && !process.env.BROWSER) {
        return false;
    }
    const browser = spawn(program, words, { detached: true, stdio: 'ignore' }).on('error', () => {});
    browser.unref();
    return browser.pid !== undefined;
}

const { words, received, isAwaited } = workerData;
const made = new Map([['/droplet-shape/studio.html', studioPage]]);
const temporary = (path, exists) => parentPort.postMessage({ path, exists });
const solver = await instantiate(fs.readFileSync(here('./droplet_shape.wasm')), (memory) => {
    const system = nodeSystem({ memory, made, temporary });
    Object.assign(system.droplet, svgDrawer(memory), {
        open_page: () => Number(openPage(studioPage())),
        received_signal: () => Atomics.load(received, 0),
        await_signals: (are_awaited) => void Atomics.store(isAwaited, 0, are_awaited),
    });
    return system;
});
const text = new TextEncoder().encode(['droplet-shape', ...words.map(posixPath)].map((word) => `${word}\0`).join(''));
const place = solver.malloc(text.length);
new Uint8Array(solver.memory.buffer, place, text.length).set(text);
process.exit(solver.droplet_command(place, text.length));
