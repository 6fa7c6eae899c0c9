// The SVG that the viewer makes of a packed texture, as JSON: node svg_text.mjs TEXTURE
import { readFileSync } from 'node:fs';
import { readPacked } from '../../web/src/packed.js';
import { svgText } from '../../web/viewer/svg-text.js';

const [texture] = process.argv.slice(2);
const data = await readPacked(readFileSync(texture), texture);
process.stdout.write(JSON.stringify(svgText(data, data.roots, data.name)));
