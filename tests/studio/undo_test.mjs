// SPDX-License-Identifier: GPL-3.0-or-later
// Takes back all that can be changed in Studio, by mouse and keys: node --test undo_test.mjs
// For the environment see browser.mjs; RAIN is the page of `windshield --live`.
import assert from 'node:assert/strict';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { kDesktop, kPhone, saved, started, studio } from './browser.mjs';
import { drawThrough, settle, stateOfDew } from './controls.mjs';

const { RAIN } = process.env;

const undo = (page) => page.keyboard.press('Control+z');
const redo = (page) => page.keyboard.press('Control+y');
const value = (page, selector) => page.locator(selector).inputValue();
const pressed = (page, selector) => page.locator(`${selector}[aria-pressed=true]`).evaluateAll((all) => all.map((each) => each.value || each.textContent));

/** The view's ground, or "own" for a picture. */
const groundOf = (page) => page.evaluate(() => document.querySelector('#swatches :checked')?.value ?? 'own');

/** Drags a slider's thumb to a part of its way. */
async function drag(page, selector, to) {
    await page.locator(selector).scrollIntoViewIfNeeded();
    const { x, y, width, height } = await page.locator(selector).boundingBox();
    const from = await page.locator(selector).evaluate(({ min, max, value: at }) => (at - min) / (max - min));
    const place = (part) => [x + 8 + part * (width - 16), y + height / 2];
    await page.mouse.move(...place(from));
    await page.mouse.down();
    await page.mouse.move(...place(to), { steps: 4 });
    await page.mouse.up();
}

/**
 * Does acts one after another, then takes back all and does all again, and compares what is read after each.
 * @param read  what the acts change
 */
async function backAndForth(page, read, ...acts) {
    const seen = [await read()];
    for (const act of acts) {
        await act();
        seen.push(await read());
        assert.notDeepEqual(seen.at(-1), seen.at(-2), `${act} changes nothing`);
    }
    for (let k = acts.length - 1; k >= 0; --k) {
        await undo(page);
        assert.deepEqual(await read(), seen[k], `${acts[k]} is not taken back`);
    }
    for (let k = 1; k <= acts.length; ++k) {
        await redo(page);
        assert.deepEqual(await read(), seen[k], `${acts[k - 1]} is not done again`);
    }
}

studio('every change of the drawing’s settings is a step', kDesktop, async (page) => {
    const tilt = '.field:has(#scene-tilt) input[type=range]';
    await page.locator('#begin').waitFor();
    await page.locator('#gallery button').nth(2).click();
    const read = async () => ({
        looks: await pressed(page, '.tiles button'), liquid: await value(page, '#liquid-liquid'), tilt: await value(page, '#scene-tilt'),
        width: await value(page, '#scene-width'), ground: await groundOf(page), name: await value(page, '#name'),
    });
    await backAndForth(page, read,
        () => page.locator('.tiles [value=ink]').click(),
        () => page.locator('.tiles [value=honey]').click(),
        async () => {
            await page.locator('#liquid-liquid').focus();
            await page.keyboard.press('ArrowDown');
        },
        () => drag(page, tilt, 0.3),
        () => drag(page, tilt, 0.7),
        async () => {
            await page.locator('#scene-width').fill('');
            await page.keyboard.type('35');
        },
        () => page.locator('#swatches label:has([value=white])').click(),
        async () => {
            await page.locator('#picture').setInputFiles({ name: 'own.png', mimeType: 'image/png', buffer: await page.screenshot() });
            await page.waitForFunction(() => document.getElementById('picture').classList.contains('chosen'));
        },
        () => page.locator('#swatches label:has([value=leaf])').click());
});

studio('what is opened or emptied can be taken back, and what changes nothing is no step', kDesktop, async (page) => {
    const title = () => page.title();
    const volume = () => page.locator('#result').textContent();
    await drawThrough(page.mouse, await page.locator('#sheet').boundingBox(), [0.3, 0.5], [0.7, 0.5]);
    await settle(page);
    const { path } = await saved(page, '[data-save=project]');
    await page.locator('#name').fill('Mine');
    await page.locator('#layer-clear').click();
    await settle(page);
    assert.equal(await volume(), '');
    await page.locator('#layer-clear').click();
    await page.locator('#layers button').first().click();
    await page.keyboard.press('Escape');
    await page.locator('#file').setInputFiles(path);
    await page.waitForFunction(() => document.title.startsWith('Droplet –'));
    await settle(page);
    assert.match(await volume(), /µL/);
    await page.locator('#view').focus();
    await undo(page);
    assert.match(await title(), /^Mine –/);
    await settle(page);
    assert.equal(await volume(), '');
    await undo(page);
    await settle(page);
    assert.match(await volume(), /µL/);
    await undo(page);
    assert.match(await title(), /^Droplet –/);
});

studio('dew has its own steps, with its ground', kDesktop, async (page) => {
    await started(page);
    const ground = () => groundOf(page);
    const first = await ground();
    await page.locator('#modes label:has([value=dew])').click();
    await page.locator('#dew-bottle').click();
    await stateOfDew(page, 'ready');
    const read = async () => ({
        kind: await value(page, '#dew-kinds :checked'), covered: await value(page, '#dew-coverage'), seed: await value(page, '#dew-seed'),
        where: await value(page, '#dew-where'), ground: await ground(),
    });
    const step = (act) => async () => {
        await act();
        await stateOfDew(page, 'ready');
    };
    await backAndForth(page, async () => {
        await stateOfDew(page, 'ready');
        return read();
    },
    step(() => drag(page, '.field:has(#dew-coverage) input[type=range]', 0.1)),
    step(() => drag(page, '.field:has(#dew-coverage) input[type=range]', 0.2)),
    step(() => page.locator('#dew-again').click()),
    step(() => page.locator('#dew-where').selectOption('above')),
    step(() => page.locator('#dew-where').selectOption('side')),
    step(() => page.locator('#dew-kinds label:has([value=rain])').click()),
    step(() => page.locator('#swatches label:has([value=white])').click()));
    await page.locator('#modes label:has([value=draw])').click();
    assert.equal(await ground(), first);
    assert.equal(await page.locator('#undo').isDisabled(), true);
});

/** A part that fills the page: what its panel shows. */
const panel = (page) => () => page.locator('.live .panel').evaluate((element) => ({
    values: [...element.querySelectorAll('output')].map(({ textContent }) => textContent),
    chosen: [...element.querySelectorAll('.choices [aria-pressed=true]')].map(({ textContent }) => textContent),
}));

studio('Splash takes back its settings', kDesktop, async (page) => {
    await page.locator('#liquid2d').click();
    await page.waitForFunction(() => document.documentElement.dataset.state === 'running');
    assert.equal(await page.locator('#liquid2d-undo').isDisabled(), true);
    await backAndForth(page, panel(page),
        () => drag(page, '#liquid2d-particles', 0.1),
        () => drag(page, '#liquid2d-gravity', 0.2),
        () => drag(page, '#liquid2d-gravity', 0.9),
        () => page.locator('#liquid2d-preset-dam').click(),
        () => page.locator('#liquid2d-preset-wave').click(),
        () => page.locator('#liquid2d-style-realistic').click(),
        () => page.locator('#liquid2d-look-night').click(),
        () => page.locator('#liquid2d-record-lottie').click());
    await page.locator('#liquid2d-undo').click();
    assert.ok((await panel(page)()).chosen.includes('Video'));
    await page.locator('#liquid2d-redo').click();
    assert.ok((await panel(page)()).chosen.includes('Lottie'));
    await page.keyboard.press('Escape');
    await undo(page);  // nothing of the drawing has been changed
    assert.equal(await page.locator('#redo').isDisabled(), true);
});

if (RAIN) {
    studio('Rain takes back its settings', { viewport: { width: 640, height: 480 } }, async (page) => {
        await page.waitForFunction(() => document.documentElement.dataset.state === 'running');
        await page.keyboard.press('h');
        await backAndForth(page, panel(page),
            () => drag(page, '#rain-rain', 0.8),
            () => drag(page, '#rain-rain', 0.6),
            () => page.getByRole('button', { name: 'Waxed' }).click(),
            () => page.locator('[id="rain-figure-3.11"]').click(),
            () => drag(page, '#rain-slope', 0.9),
            () => page.keyboard.press('w'),
            async () => {
                const bytes = await page.screenshot({ clip: { x: 0, y: 0, width: 64, height: 64 } });
                await page.locator('#rain-file').setInputFiles({ name: 'own.png', mimeType: 'image/png', buffer: bytes });
                await page.waitForFunction(() => document.documentElement.dataset.backdrop === 'own');
            });
    }, pathToFileURL(resolve(RAIN)).href);
}

studio('on a phone, the panel of Splash has buttons for it', kPhone, async (page) => {
    await page.locator('#liquid2d').tap();
    await page.waitForFunction(() => document.documentElement.dataset.state === 'running');
    await page.locator('#liquid2d-panel').tap();
    await page.locator('#liquid2d-look-ink').tap();
    await page.locator('#liquid2d-undo').tap();
    assert.ok((await panel(page)()).chosen.includes('Comic'));
});
