// Options of a conversion, of the plugin or in the query of one import.

/**
 * @typedef {object} ConvertOptions The options of `vexture convert` by the same names.
 * @property {'auto' | 'faces' | 'paint'} [split]
 * @property {boolean} [silhouette]
 * @property {boolean} [restyle]
 * @property {string} [select]
 * @property {string} [names]
 * @property {number} [snap]
 * @property {boolean} [traceImages]
 * @property {number} [tolerance]
 * @property {number} [maxDepth]
 * @property {number} [capacity]
 * @property {number} [precision]
 * @property {number} [maxSeconds]
 * @property {boolean} [strict]
 */

const SWITCHES = Object.freeze(['silhouette', 'restyle', 'traceImages', 'strict']);
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
