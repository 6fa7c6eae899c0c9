// Builds the page: `node build.mjs [FOLDER] [TOPOLOGY.json]`, by default demo/counties/ from the counties of us-atlas.
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'esbuild';
import { feature, mesh } from 'topojson-client';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const [folder = here('../../demo/counties'), source = here('node_modules/us-atlas/counties-albers-10m.json')] = process.argv.slice(2);
const BORDER = 0.35; // width of the lines between states, in the map's units: it is 975 wide

// The Albers projection of us-atlas is made for screens, whose y points down; that of GeoJSON points up.
const upright = (coordinates) =>
  typeof coordinates[0] === 'number' ? [coordinates[0], -coordinates[1]] : coordinates.map(upright);

function geojsonOf(topology) {
  const { features } = feature(topology, topology.objects.counties);
  for (const { geometry } of features) geometry.coordinates = upright(geometry.coordinates);
  return { type: 'FeatureCollection', features };
}

// By id: the county's name, that of its state, and the middle of its frame, 0..1 of the map's width.
function factsOf({ features }, topology) {
  const states = new Map(topology.objects.states.geometries.map(({ id, properties }) => [id, properties.name]));
  const [left, , right] = topology.bbox;
  return Object.fromEntries(features.map(({ id, properties, geometry }) => {
    const points = geometry.coordinates.flat(geometry.type === 'Polygon' ? 1 : 2);
    const middle = [0, 1].map((axis) => {
      const places = points.map((point) => point[axis]);
      return (Math.min(...places) + Math.max(...places)) / 2 / (right - left);
    });
    return [id, [properties.name, states.get(id.slice(0, 2)), ...middle.map((at) => Number(at.toFixed(4)))]];
  }));
}

// The lines between states and along the coast, in the frame of the counties, so that one lies on the other.
function bordersOf(topology) {
  const { coordinates } = mesh(topology, topology.objects.states);
  const [left, top, right, bottom] = topology.bbox;
  const lines = coordinates.map((line) => `M${line.map((point) => point.join(' ')).join('L')}`).join('');
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${left} ${top} ${right - left} ${bottom - top}">` +
    `<path d="${lines}" fill="none" stroke="#000" stroke-width="${BORDER}" stroke-linejoin="round"/></svg>`;
}

const topology = JSON.parse(readFileSync(source, 'utf8'));
const counties = geojsonOf(topology);
const out = (name) => resolve(folder, name);
const convert = (...options) => execFileSync('vexture', ['convert', '--tolerance', '0', ...options], { stdio: 'inherit' }); // keeps each corner
mkdirSync(folder, { recursive: true });
writeFileSync(out('counties.geojson'), JSON.stringify(counties));
writeFileSync(out('facts.json'), JSON.stringify(factsOf(counties, topology)));
writeFileSync(out('borders.svg'), bordersOf(topology));
convert(out('counties.geojson'), '--restyle', '-o', out('counties.ktx2')); // its elements are named by their ids
convert(out('borders.svg'), '--silhouette', '-o', out('borders.ktx2'));
await build({
  entryPoints: [here('src/main.js')],
  outfile: out('main.js'),
  bundle: true,
  minify: true,
  format: 'iife', // a page from the disk may not load modules
  loader: { '.ktx2': 'dataurl' },
  alias: {
    converted: resolve(folder),
    vexture: here('../../web/src/index.js'), // elsewhere: npm install vexture
    'three/addons': here('node_modules/three/examples/jsm'),
    three: here('node_modules/three'),
  },
  logLevel: 'warning',
});
copyFileSync(here('index.html'), out('index.html'));
console.log(`open ${out('index.html')}`);
