// SPDX-License-Identifier: MIT
// Texts in the chosen language. English is in the markup and in the scripts, and is the key in the tables of other languages.

const kEnglish = { tag: 'en', words: new Map(), point: '.' };
const kAttributes = ['aria-label', 'title', 'placeholder', 'alt'];
let language = kEnglish;

/**
 * Chooses the language of all texts from now on.
 * @param chosen  {tag: as of HTML's lang, words: a Map from English, point: of decimal numbers}; undefined: English
 */
export function speak(chosen = kEnglish) {
    language = chosen;
}

/** The chosen language, as HTML and numbers name it. */
export const languageTag = () => language.tag;

/** Whether a text has words: abbreviations, such as GLB, and numbers are the same in all languages. */
const hasWords = (text) => /\p{Lowercase}/u.test(text);

/** The text in the chosen language, else in English, with its {placeholders} filled. */
export function say(english, values = {}) {
    const text = hasWords(english) ? language.words.get(english) ?? english : english;
    return text.replace(/\{(\w+)\}/g, (place, name) => values[name] ?? place);
}

/** A number that is written with a point, with the decimal mark of the language. */
export const decimal = (text) => text.replace('.', language.point);

/** A count with its thousands divided. */
export const count = (value) => value.toLocaleString(language.tag);

const shown = new WeakMap();  // node → {attribute, or '' for its text: {english, text}}

/** The translation of a text, which may be one of an earlier language. White space around it stays. */
function renewed(node, name, now) {
    const texts = shown.get(node) ?? {};
    const english = texts[name]?.text === now ? texts[name].english : now;
    const text = english.replace(/\S[^]*\S|\S/, (core) => {
        const key = core.replace(/[ \n]+/g, ' ');
        const said = say(key);
        return said === key ? core : said;
    });
    shown.set(node, { ...texts, [name]: { english, text } });
    return text;
}

/**
 * Translates the texts and the attributes of an element that are in English, and again those that it has translated before.
 * Elements with translate="no" hold texts of the user, or are translated by who fills them.
 */
export function translate(root) {
    const accept = (node) => (node.nodeType === Node.ELEMENT_NODE && node.matches('[translate=no], script, style') ? NodeFilter.FILTER_REJECT :
        NodeFilter.FILTER_ACCEPT);
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_ELEMENT | NodeFilter.SHOW_TEXT, accept);
    for (let node = root; node; node = walker.nextNode()) {
        if (node.nodeType === Node.TEXT_NODE) {
            const text = renewed(node, '', node.data);
            if (text !== node.data) {
                node.data = text;
            }
            continue;
        }
        for (const name of kAttributes.filter((attribute) => node.hasAttribute(attribute))) {
            const text = renewed(node, name, node.getAttribute(name));
            if (text !== node.getAttribute(name)) {
                node.setAttribute(name, text);
            }
        }
    }
}
