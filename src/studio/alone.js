// SPDX-License-Identifier: MIT
// Studio in a file of its own, which holds the solver.
import { Keeper } from './keeper.js';
import { takeLoaded } from './page_file.js';
import { projectOf } from './project.js';
import { openStudio } from './studio.js';
import { unpackSolver } from './unpack.js';

const { text, source } = takeLoaded(document);
const opened = text ? projectOf(text).then((project) => ({ project, kept: false })) :
    Keeper.open().then(({ keeper, project }) => ({ keeper, project, kept: project !== undefined }));
Promise.all([unpackSolver(), opened]).then(([parts, rest]) => openStudio({ ...parts, ...rest, source }));
