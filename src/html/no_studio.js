// SPDX-License-Identifier: MIT
// In place of studio/from_page.js, in pages without Studio.
export const openInStudio = undefined;
