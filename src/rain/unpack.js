// SPDX-License-Identifier: MIT
// The module in the document: WebAssembly in #rain-module.

export async function unpackRain() {
    const text = document.getElementById('rain-module').textContent.trim();
    const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const bytes = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'))).arrayBuffer();
    return WebAssembly.compile(bytes);
}
