// What the package says of each file of a folder, as JSON: null, or why it refuses the file. node reading.mjs FOLDER
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { readPacked } from '../../web/src/packed.js';

const [folder] = process.argv.slice(2);
const found = {};
for (const file of readdirSync(folder)) {
  found[file] = await readPacked(readFileSync(join(folder, file))).then(
    () => null,
    (error) => (error.name === 'VextureError' ? error.message : `broken: ${error.stack}`),
  );
}
process.stdout.write(JSON.stringify(found));
