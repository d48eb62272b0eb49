// SPDX-License-Identifier: GPL-3.0-or-later
// WebKit, the engine of Safari, in the small browser that WebKitGTK brings: what pages_test.mjs needs of Puppeteer, by
// requests of W3C WebDriver. WEBKIT is the browser.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { basename, join } from 'node:path';
import { pathToFileURL } from 'node:url';

const { WEBKIT = '/usr/lib/x86_64-linux-gnu/webkit2gtk-4.1/MiniBrowser' } = process.env;
const kElement = 'element-6066-11e4-a52e-4f735466cecf';  // by which WebDriver marks an element
const kKeys = { Control: '\uE009' };

/** Lists what a page complains of, which WebDriver does not tell; it stands before the rule of what else may run. */
const kListener = `<script>
    const complaints = [];
    addEventListener('error', ({ message }) => complaints.push(message));
    addEventListener('unhandledrejection', ({ reason }) => complaints.push(String(reason)));
    console.error = (...said) => complaints.push(said.join(' '));
    console.assert = (holds, ...said) => holds || complaints.push(['assert', ...said].join(' '));
</script>`;
const kRule = '<meta http-equiv="Content-Security-Policy"';

const rest = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

let port;  // of the driver

async function freePort() {
    const server = createServer().listen(0, '127.0.0.1');
    await once(server, 'listening');
    const { port: free } = server.address();
    server.close();
    await once(server, 'close');
    return free;
}

async function ask(method, path, body) {
    const answer = await fetch(`http://127.0.0.1:${port}${path}`, { method, body: body && JSON.stringify(body) });
    const { value } = await answer.json();
    if (value?.error) {
        throw new Error(`${method} ${path}: ${value.error}: ${value.message}`);
    }
    return value;
}

class Page {
    #session;

    constructor(session) {
        this.#session = session;
        const pointer = (...actions) => this.#act({ type: 'pointer', id: 'mouse', parameters: { pointerType: 'mouse' }, actions });
        const key = (...kinds) => (value) => this.#act({ type: 'key', id: 'keyboard', actions: kinds.map((type) => ({ type, value: kKeys[value] ?? value })) });
        this.keyboard = { down: key('keyDown'), up: key('keyUp'), press: key('keyDown', 'keyUp') };
        let at = [0, 0];
        this.mouse = {
            move: async (x, y, { steps = 1 } = {}) => {
                const from = at;
                at = [x, y];
                await pointer(...Array.from({ length: steps }, (_, k) => {
                    const [to_x, to_y] = at.map((end, axis) => Math.round(from[axis] + (end - from[axis]) * (k + 1) / steps));
                    return { type: 'pointerMove', duration: 0, x: to_x, y: to_y };
                }));
            },
            down: () => pointer({ type: 'pointerDown', button: 0 }),
            up: () => pointer({ type: 'pointerUp', button: 0 }),
        };
    }

    #ask(method, path, body) {
        return ask(method, `/session/${this.#session}/${path}`, body);
    }

    #act(...actions) {
        return this.#ask('POST', 'actions', { actions });
    }

    evaluate(run, ...values) {
        const script = `const done = arguments[arguments.length - 1];
            Promise.resolve((${run})(...[...arguments].slice(0, -1))).then((value) => done({ value }), (error) => done({ error: String(error) }));`;
        return this.#ask('POST', 'execute/async', { script, args: values }).then(({ value, error }) => (error ? assert.fail(error) : value));
    }

    async waitForFunction(condition, { timeout }, ...values) {
        for (const end = performance.now() + timeout; !await this.evaluate(condition, ...values); await rest(50)) {
            assert.ok(performance.now() < end, `waited in vain for ${condition}`);
        }
    }

    async $(selector) {
        const { [kElement]: id } = await this.#ask('POST', 'element', { using: 'css selector', value: selector });
        return {
            boundingBox: () => this.evaluate((element) => element.getBoundingClientRect().toJSON(), { [kElement]: id }),
            click: () => this.#ask('POST', `element/${id}/click`, {}),
        };
    }

    async $eval(selector, run) {
        return this.evaluate(`(selector) => (${run})(document.querySelector(selector))`, selector);
    }

    async click(selector) {
        await (await this.$(selector)).click();
    }

    async screenshot({ clip: { x, y, width, height } }) {
        const whole = await this.#ask('GET', 'screenshot');
        return this.evaluate(async (base64, ...box) => {
            const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]), ...box);
            const canvas = Object.assign(document.createElement('canvas'), { width: image.width, height: image.height });
            canvas.getContext('2d').drawImage(image, 0, 0);
            return canvas.toDataURL().split(',')[1];
        }, whole, ...[x, y, width, height].map(Math.round));
    }
}

/**
 * Starts WebKit.
 * @param downloads  folder in which it saves files
 * @param size       of the pages [px]
 * @return open(file), which opens a page with nothing kept of others, and gives it and a function that closes it and
 *         gives what it complained of
 */
export async function begin(downloads, { width, height }) {
    const settings = join(downloads, 'settings');
    mkdirSync(settings);
    writeFileSync(join(settings, 'user-dirs.dirs'), `XDG_DOWNLOAD_DIR="${downloads}"\n`);
    const browserOptions = { binary: WEBKIT, args: ['--automation'] };
    return {
        async open(file) {
            const watched = join(settings, basename(file));
            const text = readFileSync(file, 'utf8');
            assert.ok(text.includes(kRule));
            writeFileSync(watched, text.replace(kRule, `${kListener}${kRule}`));
            // A driver for each: a second session of the same one does not always begin.
            port = await freePort();
            const driver = spawn('WebKitWebDriver', [`--port=${port}`], { env: { ...process.env, XDG_CONFIG_HOME: settings }, stdio: 'inherit' });
            process.once('exit', () => driver.kill());
            for (let k = 0; !await ask('GET', '/status').catch(() => false); ++k) {
                assert.ok(k < 100, 'WebKitWebDriver does not answer');
                await rest(100);
            }
            const { sessionId } = await ask('POST', '/session', { capabilities: { alwaysMatch: { 'webkitgtk:browserOptions': browserOptions } } });
            const session = `/session/${sessionId}`;
            const page = new Page(sessionId);
            await ask('POST', `${session}/timeouts`, { script: 120_000 });
            await ask('POST', `${session}/url`, { url: pathToFileURL(watched).href });
            const [wide, high] = await page.evaluate(() => [outerWidth - innerWidth, outerHeight - innerHeight]);
            await ask('POST', `${session}/window/rect`, { width: width + wide, height: height + high });
            return {
                page,
                async close() {
                    const complaints = await page.evaluate(() => complaints);
                    await ask('DELETE', session);
                    driver.kill();
                    await once(driver, 'exit');
                    return complaints;
                },
            };
        },
    };
}
