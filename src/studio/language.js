// SPDX-License-Identifier: MIT
// The languages that Studio speaks, which one it begins with, and the lists that change it.
import { speak } from '../html/words.js';
import { kGerman } from './words/de.js';
import { kFrench } from './words/fr.js';
import { kJapanese } from './words/ja.js';
import { markedLanguage } from './words/marked.js';
import { kChinese } from './words/zh.js';

const kKey = 'droplet-studio language';
/** By the first part of a browser's tag. */
const kLanguages = {
    en: { name: 'English' },
    de: { name: 'Deutsch', tag: 'de', point: ',', words: kGerman },
    fr: { name: 'Français', tag: 'fr', point: ',', words: kFrench },
    ja: { name: '日本語', tag: 'ja', point: '.', words: kJapanese },
    zh: { name: '简体中文', tag: 'zh-Hans', point: '.', words: kChinese },
};

/** The language that was chosen here before; undefined where the browser keeps nothing. */
function kept() {
    try {
        return localStorage.getItem(kKey) ?? undefined;
    } catch {
        return undefined;
    }
}

function keep(code) {
    try {
        localStorage.setItem(kKey, code);
    } catch {
        // The next opening begins with the browser's language again.
    }
}

/** The one that was chosen before, else the first of the browser's languages that Studio speaks, else English. */
function firstLanguage() {
    const tags = [kept(), ...navigator.languages].filter(Boolean).map((tag) => tag.split('-')[0]);
    return tags.find((code) => Object.hasOwn(kLanguages, code)) ?? 'en';
}

let code = 'en';

function choose(chosen) {
    code = chosen;
    speak(kLanguages[code].words && kLanguages[code]);
    document.documentElement.lang = kLanguages[code].tag ?? 'en';
}

/** Speaks from the start. */
export function beginLanguage() {
    if (kept() === 'marked') {
        speak(markedLanguage());  // for tests
    } else {
        choose(firstLanguage());
    }
}

/**
 * Fills lists with the languages, each by its own name.
 * @param changed  called when another one is spoken
 */
export function offerLanguages(lists, changed) {
    for (const list of lists) {
        list.append(...Object.entries(kLanguages).map(([value, { name, tag }]) =>
            Object.assign(new Option(name, value), { lang: tag ?? 'en', translate: false })));
        list.value = code;
        list.addEventListener('change', () => {
            choose(list.value);
            keep(code);
            lists.forEach((each) => { each.value = code; });
            changed();
        });
    }
}
