// SPDX-License-Identifier: GPL-3.0-or-later
// Runs the Khronos validator on glTF and GLB files: node validate.mjs FILE...
// One line per file, its messages below; exit 1 on any error or warning, 2 when there is nothing to validate.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

const kSeverities = ['error', 'warning', 'information', 'hint'];

const files = process.argv.slice(2);
if (files.length === 0) {
    console.error('usage: node validate.mjs FILE...');
    process.exit(2);
}

let bad = false;
for (const file of files) {
    let issues;
    try {
        // 0: no limit, so that no message hides behind others
        ({ issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)), { uri: file, maxIssues: 0 }));
    } catch (error) {
        bad = true;
        console.log(`${file}: not validated: ${error.message ?? error}`);
        continue;
    }
    bad ||= issues.numErrors > 0 || issues.numWarnings > 0;
    console.log(
        `${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ` +
            `${issues.numInfos} infos, ${issues.numHints} hints`,
    );
    for (const { severity, code, pointer, message } of issues.messages) {
        console.log(`  ${kSeverities[severity]} ${code} ${pointer ?? ''}: ${message}`);
    }
}
process.exitCode = bad ? 1 : 0;
