// node check_gltf.mjs FILE…: holds glTF files against Khronos's validator. An error or a warning fails; hints don't.

import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import validator from 'gltf-validator';

const paths = process.argv.slice(2);
let failures = 0, lights = 0;
for (const path of paths) {
    const bytes = new Uint8Array(readFileSync(path));
    const externalResourceFunction = async (uri) =>
        new Uint8Array(readFileSync(join(dirname(path), decodeURIComponent(uri))));
    const { issues } = await validator.validateBytes(bytes, { uri: path, externalResourceFunction });
    lights += JSON.parse(new TextDecoder().decode(bytes)).extensions?.KHR_lights_punctual?.lights.length ?? 0;
    if (issues.numErrors + issues.numWarnings === 0) continue;
    ++failures;
    for (const { severity, code, message, pointer } of issues.messages)
        if (severity <= 1) console.error(`${path}${pointer}: ${code}: ${message}`);
}
if (paths.length === 0) console.error('usage: node check_gltf.mjs FILE…');
console.log(`${paths.length} files, ${lights} lights, ${failures} failures`);
process.exitCode = failures > 0 || paths.length === 0 ? 1 : 0;
