// SPDX-License-Identifier: MIT
// Studio in a file of its own, which holds the solver.
import { Keeper } from './keeper.js';
import { openStudio } from './studio.js';
import { unpackSolver } from './unpack.js';

Promise.all([unpackSolver(), Keeper.open()]).then(([parts, { keeper, project }]) =>
    openStudio({ ...parts, project, keeper, kept: project !== undefined }));
