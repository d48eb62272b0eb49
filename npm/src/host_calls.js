// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the calls in host.h, for emscripten, which refuses others that nothing defines.
mergeInto(LibraryManager.library, Object.fromEntries(
    ['await_signals', 'draw_svg', 'open', 'open_page', 'open_svg', 'received_signal', 'rename_to_free', 'sleep'].map((name) => [name, () => {}])));
