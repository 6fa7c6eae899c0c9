// New colours for the elements of a planar map: another table of paints and other means, in place, for the same tree.
import { VextureError, line } from './errors.js';
import { MapMeans, listed } from './map-means.js';
import { readPaints, round } from './paints.js';
import { sendRows } from './rows.js';
import { nearNames, styleOf } from './select-root.js';
import { composited } from './style.js';

/**
 * @typedef {import('./data.js').PackedData} PackedData
 * @typedef {import('./style.js').Style} Style
 * @typedef {import('./paints.js').Paints} Paints
 *
 * @typedef {object} Coloring What new colours of a map need, found when it gets the first ones.
 * @property {number} quad index of the map's root quad
 * @property {Style} style
 * @property {Map<string, number>} named place of the first element of each name
 * @property {Int32Array} next of each element, the place of the next one of its name; -1 of the last
 * @property {Float64Array} rgba colours and opacities of the elements
 * @property {Float64Array} own those that they had at first
 * @property {import('./map-means.js').Lists} paints of each element, those in which it is seen
 * @property {Int32Array} alone of each paint, the element that it shows if that is a single one in no group; else -1
 * @property {Uint8Array} isStale of each paint, whether it is to be composited
 * @property {MapMeans} means
 */

/** @type {WeakMap<Uint32Array, Map<number, Coloring>>} */
const COLORINGS = new WeakMap();

/**
 * Give elements of a drawing other colours, in place, and send what has changed to the GPU.
 *
 * @param {PackedData} data
 * @param {number} first root of the drawing, a map with a style as all of its roots
 * @param {number} count of its roots
 * @param {import('./paints.js').PaintList} paints
 * @param {import('three').DataTexture} texture of the texels
 * @param {import('./paints.js').Colors} colors
 * @returns {boolean} whether something became visible that was not, or the reverse: then nothing is sent
 * @throws {VextureError} if one is no paint, and as `check`
 */
export function setPaints(data, first, count, paints, texture, colors) {
  const places = Array.from({ length: count }, (_, k) => first + k);
  const read = readPaints(paints, colors);
  const { appears, runs } = restyle(data, places, read, (colorings, found) => check(data.name, colorings, found, read));
  for (const [from, end] of appears ? [] : runs) sendRows(texture, Math.floor(from / data.width), Math.ceil(end / data.width));
  return appears;
}

/**
 * As `setPaints`, of one map, for who has a texture of their own, colours as numbers, and knows the names. Where an element
 * does not stay opaque, what it hides is not there to be seen.
 *
 * @param {PackedData} data
 * @param {number} root
 * @param {Paints} paints which are rounded
 * @returns {[number, number][]} first and end of each run of rows that may have changed
 */
export function recolored(data, root, paints) {
  round(paints.parts);
  const { runs } = restyle(data, [root], paints, () => {});
  return runs.map(([from, end]) => [Math.floor(from / data.width), Math.ceil(end / data.width)]);
}

/**
 * Give elements other colours: texels and the style are changed in place.
 *
 * @param {PackedData} data
 * @param {number[]} places of the roots, maps with a style
 * @param {Paints} paints
 * @param {(colorings: Coloring[], found: Int32Array[]) => void} checked throws if it may not be; before anything is changed
 * @returns {{ appears: boolean, runs: [number, number][] }} whether something became visible that was not, or the reverse;
 *   first and end of each run of texels that may have changed
 */
function restyle(data, places, { names, parts }, checked) {
  const colorings = places.map((place) => coloringOf(data, data.roots[place]));
  const found = colorings.map((coloring) => firstElements(coloring, names));
  checked(colorings, found);
  let appears = false;
  colorings.forEach((coloring, c) => { // the loops are functions of their own: V8 compiles a loop anew if more work follows it
    recolor(coloring, found[c], parts);
    appears = repaint(coloring) || appears;
    coloring.means.renew();
    for (const root of data.roots) if (root.isMap && root.quad === coloring.quad) root.style = coloring.style;
  });
  return { appears, runs: colorings.flatMap(({ means }) => means.runs) };
}

/**
 * @param {PackedData} data
 * @param {import('./data.js').Root} root
 * @returns {Coloring}
 */
function coloringOf({ texels }, root) {
  const style = styleOf(root);
  const known = COLORINGS.get(texels) ?? new Map();
  COLORINGS.set(texels, known);
  if (known.get(root.quad)?.style !== style) known.set(root.quad, prepared(texels, root.quad, style));
  return known.get(root.quad);
}

/**
 * @param {Uint32Array} texels
 * @param {number} quad
 * @param {Style} style
 * @returns {Coloring}
 */
function prepared(texels, quad, style) {
  const { elements, stacks } = style;
  const named = new Map();
  const next = new Int32Array(elements.length).fill(-1);
  const rgba = new Float64Array(4 * elements.length);
  for (let number = elements.length - 1; number >= 0; number--) {
    const { name, color, opacity } = elements[number];
    rgba.set([...color, opacity], 4 * number);
    if (!name) continue;
    next[number] = named.get(name) ?? -1;
    named.set(name, number);
  }
  const paints = listed(elements.length, (add) => {
    stacks.forEach((stack, paint) => stack.forEach((number) => add(number, paint)));
  });
  const alone = Int32Array.from(stacks, (stack) => (stack.length === 1 && elements[stack[0]].group < 0 ? stack[0] : -1));
  const isStale = new Uint8Array(stacks.length);
  return { quad, style, named, next, rgba, own: rgba.slice(), paints, alone, isStale, means: new MapMeans(texels, quad) };
}

/**
 * @param {Coloring} coloring
 * @param {string[]} names
 * @returns {Int32Array} place of the first element of each name, or -1
 */
function firstElements({ named }, names) {
  const found = new Int32Array(names.length);
  for (let k = 0; k < names.length; k++) found[k] = named.get(names[k]) ?? -1;
  return found;
}

/**
 * @param {string} texture its name
 * @param {Coloring[]} colorings
 * @param {Int32Array[]} found of each, the first element of each name, or -1
 * @param {Paints} paints
 * @throws {VextureError} if no element has a name, or one that hides others would not stay opaque
 */
function check(texture, colorings, found, { names, parts }) {
  for (let k = 0; k < names.length; k++) {
    let isKnown = false;
    for (let c = 0; c < found.length; c++) {
      isKnown ||= found[c][k] >= 0;
      if (parts[4 * k + 3] < 1) checkHiding(colorings[c], found[c][k], parts[4 * k + 3]);
    }
    if (!isKnown) refuseName(texture, names[k], colorings);
  }
}

/**
 * @param {string} texture its name
 * @param {string} name that no element has
 * @param {Coloring[]} colorings
 * @returns {never}
 */
function refuseName(texture, name, colorings) {
  const known = new Set(colorings.flatMap(({ named }) => [...named.keys()]));
  throw new VextureError(`${texture} has no element ${line(name)}; ${nearNames(name, [...known])}`, 'name');
}

/**
 * @param {Coloring} coloring
 * @param {number} first element of a name, or -1
 * @param {number} opacity that those of its name are to have
 */
function checkHiding({ style: { elements }, next }, first, opacity) {
  for (let number = first; number >= 0; number = next[number]) {
    const { name, hides } = elements[number];
    if (!hides) continue;
    throw new VextureError(
      `"${name}" gets the opacity ${opacity}, but the texture does not have what it hides; make it opaque, ` +
        'or convert the drawing with that colour', 'opacity');
  }
}

/**
 * Give elements their colours.
 *
 * @param {Coloring} coloring
 * @param {Int32Array} found the first element of each name, or -1
 * @param {Float64Array} colors for each name
 */
function recolor({ style: { elements }, next, rgba, own, paints: { starts, members }, isStale }, found, colors) {
  for (let k = 0; k < found.length; k++) {
    const isOwn = Number.isNaN(colors[4 * k]);
    const from = isOwn ? own : colors;
    for (let number = found[k]; number >= 0; number = next[number]) {
      const element = elements[number];
      const at = isOwn ? 4 * number : 4 * k;
      for (let c = 0; c < 3; c++) element.color[c] = rgba[4 * number + c] = from[at + c];
      element.opacity = rgba[4 * number + 3] = from[at + 3];
      for (let i = starts[number]; i < starts[number + 1]; i++) isStale[members[i]] = 1;
    }
  }
}

/**
 * Composite the paints of which an element has changed.
 *
 * @param {Coloring} coloring
 * @returns {boolean} whether something became visible that was not, or the reverse
 */
function repaint({ style, rgba, alone, isStale, means }) {
  const color = /** @type {import('./planar-map.js').Color} */ ([0, 0, 0, 0]);
  let appears = false;
  for (let paint = 0; paint < isStale.length; paint++) {
    if (!isStale[paint]) continue;
    isStale[paint] = 0;
    const at = 4 * alone[paint];
    if (at >= 0) {
      color[3] = rgba[at + 3];
      for (let c = 0; c < 3; c++) color[c] = rgba[at + c] * color[3];
    }
    appears = means.repaint(paint, at >= 0 ? color : composited(style, style.stacks[paint])) || appears;
  }
  return appears;
}
