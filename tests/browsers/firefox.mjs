// SPDX-License-Identifier: GPL-3.0-or-later
// Firefox, driven by Puppeteer. FIREFOX is the browser.
import { pathToFileURL } from 'node:url';
import puppeteer from 'puppeteer-core';

const { FIREFOX = '/usr/bin/firefox-esr' } = process.env;

/** Starts Firefox, as webkit.mjs does WebKit; end() ends it. */
export async function begin(downloads, size) {
    const browser = await puppeteer.launch({
        browser: 'firefox', executablePath: FIREFOX, headless: false,  // Firefox has no WebGL without a display
        args: [`--width=${size.width}`, `--height=${size.height + 100}`],
        extraPrefsFirefox: {
            'browser.download.dir': downloads, 'browser.download.folderList': 2, 'browser.download.useDownloadDir': true, 'webgl.force-enabled': true,
        },
    });
    return {
        async open(file) {
            const context = await browser.createBrowserContext();
            const page = await context.newPage();
            const complaints = [];
            page.on('pageerror', (error) => complaints.push(error.message));
            page.on('console', (message) => {
                if (['error', 'assert'].includes(message.type())) {
                    complaints.push(message.text());
                }
            });
            // Firefox tells a page of promises that nobody caught, but not the test.
            await page.evaluateOnNewDocument(() => addEventListener('unhandledrejection', ({ reason }) => console.error(String(reason))));
            await page.setViewport(size);
            await page.goto(pathToFileURL(file).href);
            return { page, close: () => context.close().then(() => complaints) };
        },
        end: () => browser.close(),
    };
}
