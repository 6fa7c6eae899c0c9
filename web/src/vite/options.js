// Options of a conversion, of the plugin or in the query of one import.

/**
 * @typedef {object} ConvertOptions The options of `vexture convert`, with the same names and defaults.
 * @property {'auto' | 'faces' | 'paint'} [split] `faces`: one planar map. `paint`: each colour as a separate shape. `auto`, the
 *   default: `faces`, or the silhouette of a drawing of one colour
 * @property {boolean} [silhouette] the covered area of a drawing, without colours
 * @property {boolean} [restyle] a planar map whose elements can get other colours later
 * @property {string} [select] only the elements that this CSS selector matches
 * @property {string} [names] property of GeoJSON, or attribute of SVG, that names elements; by default `id`
 * @property {number} [snap] largest distance at which borders of a map's polygons become one, as a fraction of the
 *   drawing's longer side
 * @property {boolean} [traceImages] trace the pictures in an SVG, instead of drawing their pixels
 * @property {boolean} [noImages] leave the pictures in an SVG out
 * @property {number} [tolerance] largest distance from the drawing's outline, in unit-square units
 * @property {number} [maxDepth] largest depth at which cells are divided
 * @property {number} [capacity] pieces in a leaf, 1 to 15
 * @property {number} [precision] largest shift by rounding, in unit-square units
 * @property {number} [maxSeconds] most seconds for one drawing
 * @property {boolean} [strict] fail if anything of a drawing is left out, simplified or invalid
 */

const SWITCHES = Object.freeze(['silhouette', 'restyle', 'traceImages', 'noImages', 'strict']);
const VALUES = Object.freeze([
  'split', 'select', 'names', 'snap', 'tolerance', 'maxDepth', 'capacity', 'precision', 'maxSeconds',
]);

/** What Vite may put into a query. */
const NOT_OURS = Object.freeze(['vexture', 'import', 't', 'url', 'no-inline']);

/** `maxDepth` of `max-depth`. @param {string} name */
const camel = (name) => name.replace(/-([a-z])/g, (_, letter) => letter.toUpperCase());

/** @param {string} name */
const kebab = (name) => name.replace(/[A-Z]/g, (letter) => `-${letter.toLowerCase()}`);

/**
 * @param {string} query
 * @returns {Record<string, string | boolean>}
 */
export function optionsOf(query) {
  const pairs = [...new URLSearchParams(query)].filter(([name]) => !NOT_OURS.includes(name));
  return Object.fromEntries(pairs.map(([name, value]) => [camel(name), SWITCHES.includes(camel(name)) ? value !== 'false' : value]));
}

/**
 * The parameters of the command line.
 *
 * @param {Record<string, unknown>} options
 * @returns {string[]}
 * @throws {Error} if there is no such option
 */
export function parametersOf(options) {
  return Object.entries(options).flatMap(([name, value]) => {
    if (value === undefined || (value === false && SWITCHES.includes(name))) return [];
    if (SWITCHES.includes(name)) return [`--${kebab(name)}`];
    if (VALUES.includes(name)) return [`--${kebab(name)}=${value}`];
    throw new Error(`no option is named ${name}; there are ${[...SWITCHES, ...VALUES].join(', ')}`);
  });
}

/** Options that need the Python program: it has more readers than this package. */
const OF_THE_PROGRAM = Object.freeze(['select', 'snap', 'traceImages', 'noImages']);

const NUMBERS = Object.freeze(['tolerance', 'maxDepth', 'capacity', 'precision', 'maxSeconds']);

/** @param {any} value @returns {any} a text as a number if it is one; other texts are refused later, as they are */
const numberOf = (value) => (String(value).trim() === '' || Number.isNaN(Number(value)) ? value : Number(value));

/**
 * The options of `convertData` of this package.
 *
 * @param {ConvertOptions} options
 * @returns {import('../convert/index.js').ConvertOptions & { strict?: boolean }}
 * @throws {Error} if one needs the Python program
 */
export function ownOptions({ silhouette, ...options }) {
  const entries = Object.entries(options).filter(([name, value]) => value !== undefined && !(value === false && SWITCHES.includes(name)));
  for (const [name] of entries) {
    if (OF_THE_PROGRAM.includes(name)) throw new Error(`${name} needs the Python program, which is not installed: pip install vexture`);
  }
  const own = Object.fromEntries(entries.map(([name, value]) => [name, NUMBERS.includes(name) ? numberOf(value) : value]));
  return silhouette ? { ...own, split: null } : own;
}
