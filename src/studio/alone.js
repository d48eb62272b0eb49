// SPDX-License-Identifier: MIT
// Studio in a file of its own, which holds the solver.
import { unpackSolver } from './unpack.js';
import { openStudio } from './studio.js';

unpackSolver().then(openStudio);
