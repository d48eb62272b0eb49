// SPDX-License-Identifier: GPL-3.0-or-later
// Studio in other languages: node --test words_test.mjs
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { dropFiles, folder, kDesktop, kPhone, started, studio } from './browser.mjs';
import { drawThrough, setValue, settle, stateOfDew } from './controls.mjs';
import { kTables, wordsOfReports, wordsOfSources } from './words.mjs';

const { SOURCES = resolve(import.meta.dirname, '../../src') } = process.env;
const { kDrawings } = await import(pathToFileURL(resolve(SOURCES, 'studio/gallery.js')).href);
const [table] = Object.values(kTables);

/** Languages: what the browser asks for, what a layer and the button to save are called, and how a droplet is told. */
const kSpoken = {
    de: { locale: 'de-AT', lang: 'de', save: 'Speichern', layer: 'Ebene 1', told: /^[\d,]+\sµL Wasser, [\d,]+\sµm hoch$/ },
    fr: { locale: 'fr-CA', lang: 'fr', save: 'Enregistrer', layer: 'Calque 1', told: /^[\d,]+\sµL d’eau, hauteur [\d,]+\sµm$/ },
    ja: { locale: 'ja-JP', lang: 'ja', save: '保存', layer: 'レイヤー 1', told: /^水 [\d.]+\sµL、高さ [\d.]+\sµm$/ },
    zh: { locale: 'zh-CN', lang: 'zh-Hans', save: '保存', layer: '图层 1', told: /^水 [\d.]+\sµL，高 [\d.]+\sµm$/ },
};

const stroke = async (page, ...points) => drawThrough(page.mouse, await page.locator('#sheet').boundingBox(), ...points);

/** Every text and every attribute that is seen or read aloud, also of what is hidden now. */
const texts = (page) => page.evaluate(() => {
    const found = [document.title];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT);
    for (let node = document.body; node; node = walker.nextNode()) {
        if (node.nodeType === Node.TEXT_NODE) {
            if (!node.parentElement.closest('script, style, code, option[lang], h1.unseen, #dew-name')) {
                found.push(node.data.trim());
            }
            continue;
        }
        found.push(...['aria-label', 'title', 'placeholder', 'alt'].map((name) => node.getAttribute(name) ?? ''));
    }
    return found.filter((text) => text !== '');
});

const kUnits = /(?<!\p{L})(?:mN\/m|N\/m|kg\/m³|m\/s²?|km\/h|mm\/h|[pnµm]?L|[nµmck]?m[²³]?|[mk]?Pa|m?s)(?![\p{L}\d])/gu;

/** Texts with words that are not marked as translated. */
const bare = async (page) => (await texts(page)).filter((text) => {
    const rest = text.replace(/⟦[^]*⟧/, '').replace(/^(bottle\.obj)? – Droplet Studio$|^Aqua$/, '');
    return /\p{Ll}/u.test(rest.replace(kUnits, ''));
});

/** Begins in the language for tests, which marks all that it translates. */
async function mark(page) {
    await page.evaluate(() => localStorage.setItem('droplet-studio language', 'marked'));
    await page.reload();
    await started(page);
}

studio('every text is translated, and the tables have no others', kDesktop, async (page) => {
    await mark(page);
    assert.deepEqual(await bare(page), []);
    for (const { name } of kDrawings) {
        assert.equal(await page.locator(`#gallery [title="⟦${name}⟧"]`).count(), 1);
    }
    await stroke(page, [0.2, 0.3], [0.5, 0.3]);
    await page.locator('#layer-add').click();
    await stroke(page, [0.3, 0.3], [0.5, 0.4]);
    await setValue(page, 'scene-tilt', 20);
    await settle(page);
    await page.locator('#times summary').click();
    assert.deepEqual(await bare(page), []);
    assert.match(await page.locator('#warnings').textContent(), /⟦⟦Layer⟧ 2 overlaps ⟦Layer⟧ 1: /);
    for (const ground of ['bowl', 'gutter']) {
        await setValue(page, 'scene-ground', ground);
        await settle(page);
        assert.deepEqual(await bare(page), []);
    }
    // Messages.
    await page.locator('#sheet').focus();
    await page.keyboard.press('ArrowLeft');
    writeFileSync(join(folder, 'wrong.json'), '{}');
    await page.locator('#file').setInputFiles(join(folder, 'wrong.json'));
    await page.waitForFunction(() => !document.getElementById('trouble').hidden);
    assert.match(await page.locator('#trouble').textContent(), /^⟦wrong\.json cannot be opened. ⟦it is not a project of Studio⟧\.⟧$/);
    assert.deepEqual(await bare(page), []);
    await dropFiles(page, '#sheet', ['bar.svg', 'image/svg+xml', Buffer.from('<svg xmlns="http://www.w3.org/2000/svg" width="8" height="8"><path d="M1 1h6v2H1z"/></svg>')]);
    await page.locator('#import').waitFor();
    await page.locator('#import [value=underlay]').click();
    await page.locator('#underlay').waitFor();
    assert.deepEqual(await bare(page), []);
    // Dew.
    await page.locator('[name=mode][value=dew]').check({ force: true });
    await stateOfDew(page, 'empty');
    assert.deepEqual(await bare(page), []);
    await page.locator('#dew-bottle').click();
    await stateOfDew(page, 'ready');
    assert.deepEqual(await bare(page), []);
    // What lies over Studio.
    for (const part of ['rain', 'liquid2d']) {
        await page.locator(`#${part}`).click();
        await page.locator('.live.ready').waitFor();
        await page.waitForFunction(() => document.querySelector('.live .panel p').textContent.trim() !== '');
        await page.keyboard.press('Space');
        assert.deepEqual(await bare(page), [], part);
        await page.keyboard.press('Escape');
        await page.waitForFunction(() => document.querySelector('.live') === null);
    }
    const asked = new Set(await page.evaluate(() => [...window.studioWords]));
    const known = new Set(table.keys());
    assert.deepEqual([...asked].filter((english) => !known.has(english)), []);
    const sources = wordsOfSources();
    assert.deepEqual([...known].filter((english) => !asked.has(english) && !sources.has(english) && !wordsOfReports().includes(english)), []);
});

for (const [code, { locale, lang, save, layer, told }] of Object.entries(kSpoken)) {
    studio(`a browser in ${locale} opens Studio in its language`, { ...kDesktop, locale }, async (page) => {
        assert.equal(await page.evaluate(() => document.documentElement.lang), lang);
        assert.equal(await page.locator('.language select').first().inputValue(), code);
        await page.getByRole('button', { name: save, exact: true }).waitFor();
        assert.equal((await page.locator('#layers label').textContent()).trim(), layer);
        await stroke(page, [0.2, 0.5], [0.8, 0.5]);
        await settle(page);
        assert.match(await page.locator('#result').textContent(), told);
        assert.match(await page.locator('#scale').textContent(), /^\d+\smm$/);
    });

    studio(`on a phone nothing is too wide in ${lang}`, { ...kPhone, locale }, async (page) => {
        const wide = () => page.evaluate(() => [
            ...[document.documentElement, document.body].filter(({ scrollWidth }) => scrollWidth > innerWidth).map(({ tagName }) => tagName),
            ...[...document.querySelectorAll('button, label, legend, summary, h2, p, th')]
                .filter((element) => element.checkVisibility() && !element.closest('.unseen') && element.scrollWidth > element.clientWidth + 1)
                .map(({ textContent, scrollWidth, clientWidth }) => `${textContent.trim()}: ${scrollWidth} > ${clientWidth}`),
        ]);
        const fits = async (what) => assert.deepEqual(await wide(), [], what);
        await fits('at first');
        await page.locator('#gallery button').nth(2).tap();
        await settle(page);
        await page.evaluate(() => document.querySelectorAll('details').forEach((each) => { each.open = true; }));
        for (const part of ['draw', 'layers', 'liquid', 'ground', 'view', 'dew']) {
            await page.locator(`#tabs [data-part=${part}]`).tap();
            await fits(part);
        }
        await page.locator('#save').tap();
        await fits('save');
        await page.locator('#tabs [data-part=view]').tap();
        const list = page.locator('#panel .language select');
        assert.equal(await list.isVisible(), true);
        await list.selectOption('en');
        assert.equal(await page.locator('#tabs [data-part=view]').textContent(), 'View');
    });
}

studio('another language changes the words and nothing else, and is kept', { ...kDesktop, locale: 'pt-BR' }, async (page) => {
    const list = page.locator('#bar .language select');
    assert.equal(await list.inputValue(), 'en');
    await stroke(page, [0.2, 0.3], [0.5, 0.3]);
    await page.locator('#layer-add').click();
    await stroke(page, [0.3, 0.3], [0.5, 0.4]);
    await settle(page);
    const english = await texts(page);
    const choose = async (code) => {
        await list.selectOption(code);
        await settle(page);
    };
    for (const code of Object.keys(kSpoken)) {
        await choose(code);
        assert.equal(await page.locator('#undo').isDisabled(), false);
        assert.equal(await page.locator('#layers li').count(), 2);
        const [spoken, same] = [await texts(page), kTables[code].get('Undo')];
        assert.equal(spoken.length, english.length);
        assert.ok(spoken.includes(same), same);
    }
    await choose('en');
    assert.deepEqual(await texts(page), english);
    // The names in the project stay as they were.
    await choose('de');
    await page.waitForFunction(() => document.documentElement.dataset.kept === 'yes');
    await page.reload();
    await started(page);
    assert.equal(await list.inputValue(), 'de');
    assert.equal((await page.locator('#layers li').last().textContent()).trim(), 'Ebene 1');
    await choose('en');
    assert.equal((await page.locator('#layers li').last().textContent()).trim(), 'Layer 1');
    assert.equal(await page.locator('#name').inputValue(), 'Droplet');
});

studio('dew and its messages follow another language', kDesktop, async (page) => {
    await page.locator('[name=mode][value=dew]').check({ force: true });
    await stateOfDew(page, 'empty');
    await page.locator('#dew-bottle').click();
    await stateOfDew(page, 'ready');
    const english = await texts(page);
    await page.locator('#bar .language select').selectOption('fr');
    assert.match(await page.locator('#result').textContent(), /^[\d\s]+ gouttes, [\d,]+\smL sur \d+\s%$/);
    assert.equal(await page.locator('#dew-open').textContent(), 'En ouvrir un autre');
    assert.equal(await page.locator('label[for=dew-contactAngle]').textContent(), 'Angle de contact');
    await page.locator('#bar .language select').selectOption('en');
    assert.deepEqual(await texts(page), english);
});

studio('where the browser refuses to keep the language, it can be changed all the same', { ...kDesktop, locale: 'fr-FR' }, async (page) => {
    await page.addInitScript(() => {
        Object.defineProperty(window, 'localStorage', { get: () => { throw new DOMException('no', 'SecurityError'); } });
    });
    await page.reload();
    await started(page);
    assert.equal(await page.evaluate(() => document.documentElement.lang), 'fr');
    await page.locator('#bar .language select').selectOption('ja');
    assert.equal(await page.locator('#layers-title').textContent(), 'レイヤー');
    assert.equal(await page.locator('#trouble').isVisible(), false);
});
