// SPDX-License-Identifier: GPL-3.0-or-later
// Opens pages from disk in a real browser and operates their controls: node drive.mjs CHROMIUM FOLDER FIGURES_JS
// FOLDER holds full.json, a report, water.html, exact.html, film.html, pictured.html, mercury.html, can.html, off_can.html,
// hostile.html and picture.png. Prints the observations as one JSON object; the test judges them.
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const [executablePath, folder, figures_source] = process.argv.slice(2);
const kWide = { width: 700, height: 300 };  // besides the panel; small, since rendering is in software
const kPhone = { width: 360, height: 640 };

const browser = await chromium.launch({
    executablePath,
    args: ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
        '--ignore-gpu-blocklist', '--disable-background-networking'],
});
const complaints = [];  // messages of console and pages
const outside = [];     // requests other than for the file itself

async function open(file, options) {
    const url = pathToFileURL(resolve(folder, file)).href;
    const context = await browser.newContext({ acceptDownloads: true, deviceScaleFactor: 0.5, ...options });
    await context.route('**', (route) => {
        const asked = route.request().url();
        if (asked === url || /^(data|blob):/.test(asked)) {
            return route.continue();
        }
        outside.push(asked);
        return route.abort();
    });
    const page = await context.newPage();
    page.setDefaultTimeout(120_000);  // enough when many tests share the processor
    page.on('console', (message) => {
        // Chromium's messages about software rendering and screenshots are expected, no others.
        if (['error', 'warning', 'assert'].includes(message.type()) && !/GPU stall due to ReadPixels|swiftshader/i.test(message.text())) {
            complaints.push(`${file}: ${message.text()}`);
        }
    });
    page.on('pageerror', (error) => complaints.push(`${file}: ${error.message}`));
    page.on('requestfailed', (request) => complaints.push(`${file}: ${request.url().slice(0, 100)} failed`));
    page.on('dialog', (dialog) => {
        complaints.push(`${file}: dialog ${dialog.message()}`);
        return dialog.dismiss();
    });
    page.on('popup', () => complaints.push(`${file}: popup`));
    await page.goto(url);
    await page.waitForFunction(() => document.documentElement.dataset.state !== 'loading');
    return page;
}

const frames = (page) => page.evaluate(() => Number(document.documentElement.dataset.frames));

/** Waits until nothing is drawn any more; what was done just now begins with the next frame. */
async function settle(page) {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await page.waitForFunction(() => document.documentElement.dataset.state === 'resting');
}

/** The droplet's part of the picture, as pixels: hashed, and how many colours there are. */
async function look(page) {
    await settle(page);
    const view = await page.locator('#view').boundingBox();
    const panel = await page.locator('#panel').boundingBox();
    const width = panel.y > view.y + 50 ? view.width : panel.x - view.x - 20;
    const height = panel.y > view.y + 50 ? panel.y - view.y - 20 : view.height;
    const png = await page.screenshot({ clip: { x: view.x, y: view.y, width, height: height - 50 }, animations: 'disabled' });
    const pixels = await page.evaluate(async (base64) => {
        const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext('2d');
        context.drawImage(image, 0, 0);
        return [...context.getImageData(0, 0, image.width, image.height).data];
    }, png.toString('base64'));
    return pixels;
}

const colours = (pixels) => {
    const found = new Set();
    for (let i = 0; i < pixels.length; i += 4) {
        found.add(pixels[i] << 16 | pixels[i + 1] << 8 | pixels[i + 2]);
    }
    return found.size;
};

/** Which part of the pixels differs by more than noise. */
const difference = (a, b) => {
    let count = 0;
    for (let i = 0; i < a.length; i += 4) {
        count += Math.max(...[0, 1, 2].map((c) => Math.abs(a[i + c] - b[i + c]))) > 8;
    }
    return a.length === b.length ? 4 * count / a.length : NaN;
};

/** The table of figures, as an object of its rows. */
const figures = (page) => page.evaluate(() => Object.fromEntries([...document.querySelectorAll('#figures tr')].map((row) =>
    [row.cells[0].textContent, row.cells[1].textContent.replaceAll('\u00a0', ' ')])));

const setFill = (page, value) => page.locator('#fill').evaluate((slider, to) => {
    slider.value = to;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
}, value);

/** What the table says of a report. */
async function told(file) {
    const { rows } = await import(pathToFileURL(figures_source).href);
    return Object.fromEntries(rows(JSON.parse(readFileSync(resolve(folder, file)))).map(([name, value]) =>
        [name, value.replaceAll('\u00a0', ' ')]));
}

async function wide() {
    const page = await open('water.html', { viewport: kWide, colorScheme: 'light' });
    const seen = {};
    const first = await look(page);
    seen.state = await page.evaluate(() => document.documentElement.dataset.state);
    seen.colours = colours(first);
    seen.range = await page.locator('#fill').evaluate(({ min, max, value }) => [min, max, value]);
    seen.labelled = await page.evaluate(() => [...document.querySelectorAll('input, button, canvas, details')].every((control) =>
        control.labels?.length || control.getAttribute('aria-label') || control.textContent.trim()));
    seen.figures = await figures(page);
    seen.scale = await page.locator('#scale').innerText();

    const before = await frames(page);
    await page.waitForTimeout(400);
    seen.frames_at_rest = await frames(page) - before;

    // The keyboard works like the mouse.
    seen.amounts = [await page.locator('#amount').innerText()];
    await page.locator('#fill').focus();
    await page.keyboard.press('End');
    seen.amounts.push(await page.locator('#amount').innerText());
    const full = await look(page);
    seen.figures_full = await figures(page);
    seen.subtitle_full = await page.locator('#subtitle').innerText();
    seen.full = difference(first, full);
    await setFill(page, 0);
    seen.amounts.push(await page.locator('#amount').innerText());
    const empty = await look(page);
    seen.empty = difference(first, empty);
    await setFill(page, 1);
    seen.filled_again = difference(first, await look(page));
    seen.figures_again = await figures(page);

    await page.locator('#view').focus();
    for (const key of ['ArrowLeft', 'ArrowLeft', 'ArrowLeft', 'ArrowUp', '+']) {
        await page.keyboard.press(key);
    }
    await page.locator('#view').blur();  // removes the focus frame
    seen.turned_by_key = difference(first, await look(page));
    await page.locator('#view').press('Home');
    await page.locator('#view').blur();
    seen.turned_back = difference(first, await look(page));

    seen.grounds = [];
    const radios = page.locator('input[name=ground]');
    for (let i = 1; i < Math.min(3, await radios.count()); ++i) {
        await radios.nth(i).check();
        seen.grounds.push(difference(first, await look(page)));
    }
    const plain = await look(page);
    await page.locator('#picture').setInputFiles(resolve(folder, 'picture.png'));
    await page.waitForFunction(() => document.querySelector('#picture').classList.contains('chosen'));
    seen.own_picture = difference(plain, await look(page));

    const [download] = await Promise.all([page.waitForEvent('download'), page.locator('#download').click()]);
    const embedded = await page.evaluate(() => document.getElementById('model').textContent);
    seen.download = {
        name: download.suggestedFilename(),
        sha256: createHash('sha256').update(readFileSync(await download.path())).digest('hex'),
        embedded: createHash('sha256').update(Buffer.from(embedded, 'base64')).digest('hex'),
    };
    await setFill(page, 2);
    const [filled] = await Promise.all([page.waitForEvent('download'), page.locator('#download').click()]);
    await filled.saveAs(resolve(folder, 'filled.glb'));
    await page.context().close();
    return seen;
}

/** Shades of grey where a droplet of mercury is: by tenths, from black to white. */
async function mercury() {
    const page = await open('mercury.html', { viewport: kWide, colorScheme: 'light' });
    const pixels = await look(page);
    const shares = new Array(10).fill(0);
    const { length } = pixels;
    for (let i = 0; i < length; i += 4) {
        shares[Math.min(9, Math.floor(pixels[i + 1] / 25.6))] += 4 / length;
    }
    await page.context().close();
    return shares;
}

async function phone() {
    const page = await open('water.html', { viewport: kPhone, hasTouch: true, isMobile: true, colorScheme: 'dark', reducedMotion: 'reduce' });
    const seen = {};
    const first = await look(page);
    seen.colours = colours(first);
    seen.overflow = await page.evaluate(() => Math.max(document.documentElement.scrollWidth, document.body.scrollWidth) - innerWidth);
    seen.reachable = {};
    for (const id of ['fill', 'download', 'reset', 'picture']) {
        // Finds the element that a finger at its middle would touch.
        seen.reachable[id] = await page.locator(`#${id}`).evaluate((control) => {
            control.scrollIntoView({ block: 'nearest' });
            const box = control.getBoundingClientRect();
            const hit = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
            return box.left >= 0 && box.right <= innerWidth && Math.min(box.width, box.height) >= 28 &&
                (hit === control || control.parentElement.contains(hit));
        });
    }
    const slider = await page.locator('#fill').boundingBox();
    await page.touchscreen.tap(slider.x + 0.8 * slider.width, slider.y + slider.height / 2);
    seen.fill = Number(await page.locator('#fill').inputValue());
    seen.filled = difference(first, await look(page));
    await page.locator('#reset').tap();

    const touch = await page.context().newCDPSession(page);
    const fingers = (type, ...points) => touch.send('Input.dispatchTouchEvent',
        { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const rest = await look(page);
    await fingers('touchStart', [150, 150]);
    for (let i = 1; i <= 4; ++i) {
        await fingers('touchMove', [150 + 15 * i, 150 + 4 * i]);
    }
    await fingers('touchEnd');
    const dragged = await look(page);
    seen.dragged = difference(rest, dragged);
    await fingers('touchStart', [160, 150], [200, 150]);
    for (let i = 1; i <= 4; ++i) {
        await fingers('touchMove', [160 - 10 * i, 150], [200 + 10 * i, 150]);
    }
    await fingers('touchEnd');
    seen.pinched = difference(dragged, await look(page));
    seen.page_zoom = await page.evaluate(() => visualViewport.scale);
    await page.locator('#figures summary').tap();
    seen.overflow_open = await page.evaluate(() => Math.max(document.documentElement.scrollWidth, document.body.scrollWidth) - innerWidth);
    seen.panel_height = await page.evaluate(() => document.getElementById('panel').getBoundingClientRect().height / innerHeight);
    await page.context().close();
    return seen;
}

async function exact() {
    const page = await open('exact.html', { viewport: kWide, colorScheme: 'light' });
    const seen = {
        slider: await page.locator('#refill').isVisible(),
        state: await page.evaluate(() => document.documentElement.dataset.state),
    };
    await page.context().close();
    return seen;
}

/** A film of three frames a second: a droplet, another one, none. */
async function film() {
    const page = await open('film.html', { viewport: kWide, colorScheme: 'light', reducedMotion: 'reduce' });
    const seen = { refill: await page.locator('#refill').isVisible(), moments: [], shown: [] };
    const at = async (seconds) => {
        await page.locator('#time').evaluate((slider, to) => {
            slider.value = to;
            slider.dispatchEvent(new Event('input', { bubbles: true }));
        }, seconds);
        seen.moments.push(await page.locator('#moment').innerText());
        return look(page);
    };
    const first = await at(0);
    for (const seconds of [0.4, 0.7, 1, 0]) {
        seen.shown.push(difference(first, await at(seconds)));
    }
    seen.duration = Number(await page.locator('#time').getAttribute('max'));
    const time = async () => Number(await page.locator('#time').inputValue());
    seen.words = [await page.locator('#play').innerText()];
    await page.locator('#play').click();
    await page.waitForFunction(() => Number(document.getElementById('time').value) > 0.2);
    seen.words.push(await page.locator('#play').innerText());
    await page.locator('#play').click();
    const paused = await time();
    await settle(page);
    seen.moved_in_pause = await time() - paused;
    await page.context().close();
    // Without prefers-reduced-motion the animation plays by itself.
    const plays = await open('film.html', { viewport: kWide });
    await plays.waitForFunction(() => Number(document.getElementById('time').value) > 0.1);
    await plays.context().close();
    return seen;
}

/** Share of pixels in which one colour is clearly stronger than another. */
const stronger = (pixels, strong, weak) => {
    let found = 0;
    for (let i = 0; i < pixels.length; i += 4) {
        found += pixels[i + strong] > 60 + pixels[i + weak];
    }
    return 4 * found / pixels.length;
};

/** How many pixels are clearly red and clearly green. */
async function pictured() {
    const page = await open('pictured.html', { viewport: kWide });
    const pixels = await look(page);
    await page.context().close();
    return { red: stronger(pixels, 0, 1), green: stronger(pixels, 1, 0) };
}

/** How many pixels are clearly red, with a droplet on a red can and with the droplet alone. */
async function laid() {
    const page = await open('can.html', { viewport: kWide });
    const seen = { red: stronger(await look(page), 0, 1), refill: await page.locator('#refill').isVisible(),
        figures: await figures(page) };
    await page.context().close();
    const alone = await open('off_can.html', { viewport: kWide });
    seen.red_alone = stronger(await look(alone), 0, 1);
    await alone.context().close();
    return seen;
}

async function hostile() {
    const page = await open('hostile.html', { viewport: kWide });
    const seen = await page.evaluate(() => ({
        state: document.documentElement.dataset.state,
        executed: 'executed' in window,
        title: document.title,
        heading: document.getElementById('title').textContent,
        scripts: document.scripts.length,
        images: document.images.length,
        trouble: !document.getElementById('trouble').hidden,
        download: document.getElementById('download').checkVisibility(),
    }));
    // The policy forbids even an injected script.
    seen.forbidden = await page.evaluate(() => {
        const script = document.createElement('script');
        script.textContent = 'window.executed = true';
        document.body.append(script);
        return !('executed' in window);
    });
    await page.context().close();
    return seen;
}

try {
    const seen = { wide: await wide(), phone: await phone(), exact: await exact(), told_full: await told('full.json'), film: await film(),
        pictured: await pictured(), laid: await laid(), mercury: await mercury() };
    Object.assign(seen, { complaints: [...complaints], outside });
    complaints.length = 0;
    seen.hostile = await hostile();
    seen.hostile_complaints = complaints;
    console.log(JSON.stringify(seen));
} finally {
    await browser.close();
}
