// SPDX-License-Identifier: GPL-3.0-or-later
// Opens Studio in a real browser for tests, each in a page of its own.
// STUDIO is the HTML file, CHROMIUM the browser.
import assert from 'node:assert/strict';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const { STUDIO, CHROMIUM = '/usr/bin/chromium' } = process.env;
export const kStudio = pathToFileURL(resolve(STUDIO)).href;
export const kDesktop = { viewport: { width: 1100, height: 640 } };
export const kPhone = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

let browser;
/** For files of the tests. */
export const folder = mkdtempSync(join(tmpdir(), 'studio-'));
before(async () => {
    browser = await chromium.launch({
        executablePath: CHROMIUM, args: ['--headless=new', '--no-sandbox', '--enable-unsafe-swiftshader', '--disable-background-networking'],
    });
});
after(async () => {
    await browser.close();
    rmSync(folder, { recursive: true });
});

/** Waits until Studio runs in a page. */
export const started = (page) => page.waitForFunction(() => document.documentElement.dataset.solver === 'ready');

/** A context for one page, in which nothing may be fetched; lists what it complains of. */
export async function watched(options, url) {
    const context = await browser.newContext({ acceptDownloads: true, ...options });
    const complaints = [];
    await context.route('**', (route) => {
        const asked = route.request().url();
        if (asked.split('#')[0] === url || /^(data|blob):/.test(asked)) {
            return route.continue();
        }
        complaints.push(`request of ${asked}`);
        return route.abort();
    });
    context.setDefaultTimeout(120_000);  // enough when many tests share the processor
    context.on('console', (message) => {
        // Chromium's messages about software rendering are expected, no others.
        if (['error', 'warning', 'assert'].includes(message.type()) && !/GPU stall due to ReadPixels|swiftshader/i.test(message.text())) {
            complaints.push(message.text());
        }
    });
    context.on('weberror', (error) => complaints.push(error.error().message));
    return { context, complaints };
}

/** Runs a test in a page of its own, in which nothing may complain and nothing may be fetched. */
export function studio(name, options, run, url = kStudio) {
    test(name, async () => {
        const { context, complaints } = await watched({ deviceScaleFactor: 0.5, colorScheme: 'light', ...options }, url);
        context.on('dialog', (dialog) => {
            if (dialog.type() === 'beforeunload') {
                return dialog.accept();
            }
            complaints.push(`dialog ${dialog.message()}`);
            return dialog.dismiss();
        });
        const page = await context.newPage();
        page.on('popup', () => complaints.push('popup'));
        await page.goto(url);
        await page.waitForFunction((alone) => document.documentElement.dataset[alone ? 'solver' : 'state'] !== (alone ? undefined : 'loading'), url === kStudio);
        await run(page);
        assert.deepEqual(complaints, []);
        await context.close();
    });
}

/** Saves through a button of a menu. */
export async function saved(page, button) {
    await page.locator('#save').click();
    const [file] = await Promise.all([page.waitForEvent('download'), page.locator(button).click()]);
    const path = join(folder, file.suggestedFilename());
    await file.saveAs(path);
    return { name: file.suggestedFilename(), path, bytes: readFileSync(path) };
}

export const jsonOf = (glb) => JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString());

/** Drops files onto an element: lists of name, type and bytes. */
export async function dropFiles(page, onto, ...files) {
    const transfer = await page.evaluateHandle((list) => {
        const data = new DataTransfer();
        for (const [name, type, base64] of list) {
            data.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name, { type }));
        }
        return data;
    }, files.map(([name, type, bytes]) => [name, type, Buffer.from(bytes).toString('base64')]));
    await page.dispatchEvent(onto, 'drop', { dataTransfer: transfer });
}
