// What the package's JavaScript finds in a packed texture, as JSON: node walk_points.mjs TEXTURE POINTS.json
import { readFileSync } from 'node:fs';
import { readPacked } from '../../web/src/packed.js';
import { paintAt } from '../../web/src/walk-map.js';
import { bounds, cellAt, contains, counts } from '../../web/src/walk.js';

const [texture, list] = process.argv.slice(2);
const data = await readPacked(readFileSync(texture), texture);
const points = JSON.parse(readFileSync(list, 'utf8'));
const found = data.roots.map(({ name, quad, isMap }) => ({
  name,
  inside: points.map(([u, v]) => contains(data, quad, u, v)),
  cells: points.map(([u, v]) => cellAt(data, quad, u, v)),
  painted: isMap ? points.map(([u, v]) => paintAt(data, quad, u, v)) : null,
  counts: counts(data, quad),
  bounds: bounds(data, quad),
}));
process.stdout.write(JSON.stringify(found));
