// SPDX-License-Identifier: MIT
// Studio's own page as a file that opens with a project: to send a drawing to somebody who has nothing but a browser.

const kElement = 'project';

/**
 * What this page was loaded with, before Studio takes the place of what is in it.
 * @return {text: of its project, or undefined, source: of the page without one}
 */
export function takeLoaded(document) {
    const element = document.getElementById(kElement);
    element?.remove();
    const serializer = new XMLSerializer();
    const parts = [...document.childNodes].map((node) => node.outerHTML ?? serializer.serializeToString(node));
    return { text: element?.textContent, source: parts.join('\n') };
}

/** The page with a project. */
export function pageWith(source, text) {
    const element = Object.assign(document.createElement('script'), { id: kElement, type: 'application/json' });
    element.textContent = text.replaceAll('<', '\\u003c');
    return source.replace(/<body[^>]*>/, (body) => `${body}${element.outerHTML}`);
}
