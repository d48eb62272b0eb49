// SPDX-License-Identifier: GPL-3.0-or-later
// Takes the picture of docs/cli/windshield.md: node rain.mjs CHROMIUM PLAYWRIGHT_FOLDER RAIN_HTML PNG
// Mist on a wet evening, into which a finger has drawn.
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [executablePath, playwright, rain, picture] = process.argv.slice(2);
const { chromium } = createRequire(import.meta.url)(playwright);
const kWidth = 960;
const kHeight = 540;

const browser = await chromium.launch({
    executablePath,
    args: ['--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
const page = await browser.newPage({ viewport: { width: kWidth, height: kHeight } });
page.setDefaultTimeout(600_000);
const frames = async (count) => {
    const now = await page.evaluate(() => Number(document.documentElement.dataset.frames ?? 0));
    await page.waitForFunction((until) => Number(document.documentElement.dataset.frames) >= until, now + count);
};
const set = (name, value) => page.locator(`#rain-${name}`).evaluate((slider, to) => {
    slider.value = to;
    slider.dispatchEvent(new Event('input', { bubbles: true }));
}, String(value));

// Sizes stay, however slow the frames are.
await page.goto(`${pathToFileURL(rain).href}#full`);
await page.waitForFunction(() => document.documentElement.dataset.state === 'running');
await set('mist', 1);
await set('rain', 1.6);
await set('distance', 26);
await page.keyboard.press('b');  // twenty seconds of that
await frames(2);
// The hand draws while the rain waits.
await page.keyboard.press(' ');
await page.waitForFunction(() => document.documentElement.dataset.state === 'paused');
const at = (t) => [kWidth * (0.24 + 0.5 * t), kHeight * (0.52 + 0.2 * Math.sin(2 * Math.PI * t))];
await page.mouse.move(...at(0));
await page.mouse.down();
for (let k = 1; k <= 20; ++k) {
    await page.mouse.move(...at(k / 20));
}
await page.mouse.up();
await page.keyboard.press(' ');
await frames(6);
await page.evaluate(() => document.querySelectorAll('.rain .bar, .rain .hint').forEach((part) => part.remove()));
await frames(2);
await page.screenshot({ path: picture });
await browser.close();
