/**
 * Conversion of drawings in the browser and in Node.js, by the kernels of the Python package, compiled to WebAssembly.
 *
 * @module
 */
import { VextureError, givenOptions, line, unfit } from '../errors.js';
import { loadMaps, mapParts } from '../maps.js';
import { Converter } from './converter.js';
import { pictureSize } from './decode-picture.js';
import { describeContent } from './file-kinds.js';
import { Pace } from './pace.js';
import { readPicture } from './read-picture.js';
import { readPacedGeojson } from './read-geojson.js';
import { loadContent, textOf } from './source.js';
import { svgDrawing } from './svg.js';

export { VextureError } from '../errors.js';
export { Converter } from './converter.js';
export { fromContours } from './drawing.js';
export { readGeojson } from './read-geojson.js';
export { writePacked } from './write-packed.js';

/** @import { PackedData } from '../data.js' */
/** @import { VectorTexture } from '../vector-texture.js' */
/** @typedef {import('./affine.js').Affine} Affine */
/** @typedef {import('./converter.js').ConverterOptions} ConverterOptions */
/** @typedef {import('./converter.js').Job} Job */
/** @typedef {import('./conversion.js').ConversionOptions} ConversionOptions */
/** @typedef {import('./conversion.js').Converted} Converted */
/** @typedef {import('./drawing.js').Box} Box */
/** @typedef {import('./drawing.js').Drawing} Drawing */
/** @typedef {import('./drawing.js').Shape} Shape */
/** @typedef {import('./kernel-modules.js').KernelSource} KernelSource */
/** @typedef {import('./kernel-modules.js').KernelSources} KernelSources */
/** @typedef {import('./kernel-modules.js').ModuleName} ModuleName */
/** @typedef {import('./notes.js').Kind} Kind */
/** @typedef {import('./notes.js').Note} Note */
/** @typedef {import('./pace.js').PaceOptions} PaceOptions */
/** @typedef {import('./painter.js').Path} Path */
/** @typedef {import('./paints.js').Color} Color */
/** @typedef {import('./paints.js').Gradient} Gradient */
/** @typedef {import('./paints.js').Paint} Paint */
/** @typedef {import('./paints.js').Picture} Picture */
/** @typedef {import('./decode-picture.js').Pixels} Pixels */
/** @typedef {import('./paints.js').Rows} Rows */
/** @typedef {import('./paints.js').Stop} Stop */
/** @typedef {import('./read-geojson.js').GeojsonLook} GeojsonLook */
/** @typedef {import('./read-geojson.js').GeojsonOptions} GeojsonOptions */
/** @typedef {import('./split.js').Split} Split */
/** @typedef {import('./strokes.js').StrokeOutline} StrokeOutline */
/** @typedef {import('./strokes.js').StrokeStyle} StrokeStyle */
/** @typedef {import('./veils.js').Group} Group */

/**
 * @typedef {string | URL | Blob | ArrayBuffer | Uint8Array | SVGElement | Drawing | object} Source What can be converted: the
 *   text of an SVG, GeoJSON or TopoJSON, or its address; a file, of a picture, too; an element of the page; parsed GeoJSON; a drawing that
 *   `readSvg`, `readGeojson` or `fromContours` has made
 *
 * @typedef {object} ConvertOptions Options of a conversion; those with a counterpart in Python's `vexture.convert` mean the same.
 * @property {string} [name] name of the shape; by default that of the file, or `drawing`
 * @property {Split} [split] `faces`: the drawing in its colours as one planar map. `paint`: a shape for each layer of one paint.
 *   null: the silhouette. `auto`, the default: `faces` if there are several colours
 * @property {number} [tolerance] largest distance between the drawing's outline and the texture's, in unit-square units; 2e-5
 *   by default, or 0 with a `precision`
 * @property {number} [maxDepth] depth at which cells are not divided, 1..20; 16 by default
 * @property {number} [capacity] most pieces in a leaf, 1..15; 8 by default, 12 in a planar map
 * @property {number} [precision] largest shift of the outline by rounding, in unit-square units
 * @property {boolean} [restyle] keep elements apart, so that `setPaints` can change their colours
 * @property {string} [names] property of GeoJSON that names the elements; those of an SVG have their `id`
 * @property {AbortSignal} [signal] stops the conversion, which rejects with its reason
 * @property {number} [maxSeconds] time limit of reading and converting together; 60 by default
 * @property {(progress: { stage: 'read' | 'convert' | 'done' }) => void} [onProgress] called at the start of each stage
 * @property {Converter} [converter] by default one of the package, with a worker of its own
 *
 * @typedef {PackedData & { notes: Note[] }} ConvertedData a texture's data, and what was left out, simplified or chosen
 */

const OPTIONS = new Set(['name', 'split', 'tolerance', 'maxDepth', 'capacity', 'precision', 'restyle', 'names', 'signal', 'maxSeconds',
  'onProgress', 'converter']);

/** @type {Converter | null} */
let own = null;

/**
 * Convert a drawing to a texture, in a worker.
 *
 * @param {Source} source
 * @param {ConvertOptions} [options]
 * @returns {Promise<VectorTexture & { notes: Note[] }>} its `notes` list what was left out, simplified or chosen
 * @throws {VextureError} if it cannot be read or converted
 */
export async function convert(source, options) {
  const { notes, ...data } = await convertData(source, options);
  const { VectorTexture } = await import('../vector-texture.js'); // Node.js may have no three.js
  return Object.assign(new VectorTexture(data), { notes });
}

/**
 * Convert as `convert` does, to plain data, without three.js.
 *
 * @param {Source} source
 * @param {ConvertOptions} [options]
 * @returns {Promise<ConvertedData>}
 * @throws {VextureError} if it cannot be read or converted
 */
export async function convertData(source, options) {
  const { name, names, signal, maxSeconds, onProgress, converter = usual(), ...others } = checked(options);
  const pace = new Pace({ signal, maxSeconds });
  onProgress?.({ stage: 'read' });
  const drawing = await read(source, { name, names, signal, converter, pace });
  onProgress?.({ stage: 'convert' });
  const converted = await converter.convert({ drawing, options: { ...others, maxSeconds }, signal, spent: pace.seconds });
  if (converted.roots.some(({ isMap }) => isMap)) {
    await loadMaps();
    for (const root of converted.roots) if (root.isMap) mapParts().checkPaintsOf(root, converted.texels);
  }
  onProgress?.({ stage: 'done' });
  return { encoding: 'packed', ...converted };
}

/**
 * Read an SVG. In a page the browser computes its styles, in a frame without scripts and network; in Node.js this package
 * does.
 *
 * @param {string | Blob | ArrayBuffer | Uint8Array | URL | Response | Element} source text, file or address, or an element of
 *   the page with the styles that it has there
 * @param {{ name?: string, converter?: Converter } & PaceOptions} [options] the converter has the kernels that outline strokes
 * @returns {Promise<Drawing>} its `notes` list what was left out, simplified or invalid
 * @throws {VextureError} if it is no SVG, or exceeds a limit
 */
export async function readSvg(source, { signal, maxSeconds, ...options } = {}) {
  return readPaced(source, { ...options, signal, pace: new Pace({ signal, maxSeconds }) });
}

/**
 * Read an SVG as `readSvg` does, with limits of time that others share.
 *
 * @param {Parameters<typeof readSvg>[0]} source
 * @param {{ name?: string, converter?: Converter, signal?: AbortSignal, pace: Pace }} options
 * @returns {Promise<Drawing>}
 */
async function readPaced(source, { name = 'drawing', converter = usual(), signal, pace }) {
  return svgDrawing(source, { name, signal, pace, loadStrokes: () => converter.strokeOutline() }).catch((error) => {
    throw error instanceof VextureError ? error.in(name) : error;
  });
}

/** The package's converter, made when it is first needed. */
function usual() {
  own ??= new Converter();
  return own;
}

/**
 * @param {ConvertOptions | undefined} options
 * @returns {ConvertOptions}
 */
function checked(options) {
  const given = givenOptions(options);
  for (const name of Object.keys(given)) {
    if (!OPTIONS.has(name)) throw new VextureError(`\`${name}\` is no option of a conversion; there are ${[...OPTIONS].join(', ')}`, name);
  }
  return Object.fromEntries(Object.entries(given).filter(([, value]) => value !== undefined));
}

/**
 * @param {any} source
 * @param {Pick<ConvertOptions, 'name' | 'names' | 'signal' | 'converter'> & { pace: Pace }} options
 * @returns {Promise<Drawing>}
 */
async function read(source, options) {
  const { name } = options;
  if (Array.isArray(source?.paths) && Array.isArray(source.groups)) return name === undefined ? source : { ...source, name };
  if (typeof Element === 'function' && source instanceof Element) return readNamed(source, { ...options, name: name ?? (source.id || undefined) });
  const isMarkup = typeof source === 'string' && /^\ufeff?\s*[<{]/.test(source);
  const isPlace = source instanceof URL || (typeof source === 'string' && !isMarkup);
  const isFile = isPlace || source instanceof Response || source instanceof Blob || source instanceof ArrayBuffer || source instanceof Uint8Array;
  if (!isMarkup && !isFile) {
    if (typeof source === 'object' && source !== null) return readPacedGeojson(source, options, options.pace);
    throw unfit('source', source, 'give an SVG or GeoJSON as a text, address, file or element');
  }
  const content = isMarkup ? source : await loadContent(isPlace ? placeOf(source) : source, options);
  const stem = isPlace ? stemOf(String(source)) : typeof File === 'function' && source instanceof File ? stemOf(source.name) : undefined;
  const named = { ...options, name: name ?? stem };
  if (typeof content !== 'string' && pictureSize(content)) return readPicture(content, named.name);
  const text = textOf(content);
  const start = text.replace(/^\ufeff/, '').trimStart()[0];
  if (start === '<') return readNamed(text, named);
  if (start === '{') return readPacedGeojson(text, named, named.pace);
  const file = typeof File === 'function' && source instanceof File ? line(source.name) : stem ?? 'the source';
  throw new VextureError(`${file} ${describeContent(text)}`, 'source');
}

/**
 * Read an SVG, whose elements have the names of their `id`.
 *
 * @param {string | Element} source
 * @param {{ name?: string, names?: string, converter?: Converter, signal?: AbortSignal, pace: Pace }} options
 */
function readNamed(source, { names = 'id', ...options }) {
  if (names === 'id') return readPaced(source, options);
  throw new VextureError(`\`names\` ${line(names)} of an SVG needs the Python program; elements have the names of their \`id\` here`, 'names');
}

/** @param {string | URL} source @returns {URL} @throws {VextureError} if it is no address */
function placeOf(source) {
  try {
    if (String(source).trim()) return new URL(source, globalThis.document?.baseURI); // a blank address is that of the page
  } catch { // refused below
  }
  throw new VextureError(`the source ${line(source)} is no address; give an SVG or GeoJSON as a text, address, file or element`, 'source');
}

/** @param {string} path @returns {string | undefined} name of the file without its suffix, nor that of gzip; none of an address that is the data */
function stemOf(path) {
  if (/^(?:data|blob):/i.test(path)) return undefined;
  const file = path.replace(/[?#].*$/s, '').split(/[\\/]/).at(-1) ?? '';
  const stem = file.replace(/\.gz$/i, '').replace(/\.[a-z]+$/i, '');
  try {
    return decodeURIComponent(stem) || undefined;
  } catch {
    return stem || undefined;
  }
}
