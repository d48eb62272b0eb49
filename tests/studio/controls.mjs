// SPDX-License-Identifier: GPL-3.0-or-later
// What a user does in Studio, for tests and for scripts/screenshots. The first is for every program that drives a browser.

/** Draws with a mouse through points, as parts of a box's width and height. */
export async function drawThrough(mouse, box, ...points) {
    const at = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
    await mouse.move(...at(points[0]));
    await mouse.down();
    for (const point of points.slice(1)) {
        await mouse.move(...at(point), { steps: 5 });
    }
    await mouse.up();
}

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
