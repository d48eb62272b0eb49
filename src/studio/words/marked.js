// SPDX-License-Identifier: MIT
// A language for tests: English in brackets, so that a text which is not translated is seen. window.studioWords has all texts
// that were asked for.

/** As speak() takes it. */
export function markedLanguage() {
    const asked = new Set();
    window.studioWords = asked;
    return {
        tag: 'en', point: '.',
        words: {
            get(english) {
                if (english.includes('\u27e6')) {
                    return undefined;  // translated already
                }
                asked.add(english);
                return `\u27e6${english}\u27e7`;
            },
        },
    };
}
