// SPDX-License-Identifier: MIT
// The module in the document, as bundling.mjs writes it.

/** @param element  of moduleElement() */
export async function unpackModule(element) {
    const text = element.textContent.trim();
    const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const bytes = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).arrayBuffer();
    return WebAssembly.compile(bytes);
}
