// SPDX-License-Identifier: GPL-3.0-or-later
// What a user does in Studio, for tests and for scripts/screenshots.

/** Waits until all whole meshes are shown and nothing moves. */
export async function settle(page) {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await page.waitForFunction(() => document.documentElement.dataset.droplets === 'ready' && document.documentElement.dataset.state === 'resting');
}

export const choose = (page, tool) => page.locator(`#tools [value=${tool}]`).check({ force: true });

export const setValue = (page, id, value) => page.locator(`#${id}`).evaluate((control, to) => {
    control.value = to;
    control.dispatchEvent(new Event('input', { bubbles: true }));
    control.dispatchEvent(new Event('change', { bubbles: true }));
}, String(value));

/** Waits until dew is in a state: ready, refused or empty, with nothing left to do. */
export async function stateOfDew(page, state) {
    await page.waitForFunction(() => document.documentElement.dataset.dew !== undefined);
    await page.waitForFunction((wanted) => document.documentElement.dataset.dew === wanted, state);
}
