// SPDX-License-Identifier: MIT
// Rain in a file of its own, which holds the module and the values that the command has put there.
import { openRain } from './rain.js';
import { unpackModule } from '../live/unpack.js';

const text = document.getElementById('rain-values').textContent.trim();
unpackModule(document.getElementById('rain-module')).then((wasm) => openRain(document.body, wasm, text.startsWith('{') && !text.startsWith('{{') ? JSON.parse(text) : {}));
