// SPDX-License-Identifier: MIT
// Bundles widget.js and three.js into one module for notebooks: node bundle_widget.mjs SOURCES OUTPUT.js
// Run it in the folder of `npm ci`.
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { bundleScript, threeLicence } from './bundling.mjs';

const [sources, output] = process.argv.slice(2);
const script = await bundleScript(join(sources, 'widget.js'), { format: 'esm' });
writeFileSync(output, `// SPDX-License-Identifier: MIT
// Copyright (c) the droplet-shape authors. It holds three.js and its add-ons, of which holds:
${threeLicence().replace(/^/gm, '// ')}
${script}
`);
