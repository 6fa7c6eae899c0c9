/**
 * Text in a three.js scene that may change in every frame: exact at every size and tilt, in any script.
 *
 * @module
 */
import { MeshBasicMaterial } from 'three';
import { applyVectorMask } from '../vector-mask.js';
import { batchedTextOf } from './batched-text.js';
import { textOf } from './text.js';

export { VextureError } from '../errors.js';
export { AtlasFont } from './atlas-font.js';
export { bakeFont } from './bake-font.js';
export { NOTO_SANS, setDefaultFont } from './faces.js';
export { loadFontFaces } from './font-css.js';
export { Glyphs } from './glyphs.js';
export { getCaretAtPoint, getSelectionRects } from './layout.js';

/** @typedef {import('./faces.js').FontFace} FontFace */
/** @typedef {import('./faces.js').FontFile} FontFile */
/** @typedef {import('./faces.js').FontSource} FontSource */
/** @typedef {import('./glyphs.js').GlyphsOptions} GlyphsOptions */
/** @typedef {import('./atlas-font.js').AtlasGlyph} AtlasGlyph */
/** @typedef {import('./atlas-font.js').AtlasMetrics} AtlasMetrics */
/** @typedef {import('./batched-text.js').BatchOptions} BatchOptions */
/**
 * @typedef {import('./label.js').Label} Label one of the labels of a `BatchedText`. Its `position`, `quaternion`, `scale`,
 *   `color`, `opacity` and `visible` can be changed at any time, for the next frame; `set(options)` and `text` change the rest
 */
/** @typedef {import('./label.js').LabelOptions} LabelOptions */
/** @typedef {import('./layout.js').PlacedShapes} PlacedShapes */
/** @typedef {import('./layout.js').Rectangle} Rectangle */
/** @typedef {import('./layout.js').TextLayout} TextLayout */
/** @typedef {import('./layout.js').TextLine} TextLine */
/** @typedef {import('./layout.js').TextMeasures} TextMeasures */
/** @typedef {import('./text-options.js').ArrangementOptions} ArrangementOptions */
/** @typedef {import('./text-options.js').LayoutOptions} LayoutOptions */
/** @typedef {import('./text-options.js').LookOptions} LookOptions */
/** @typedef {import('./text-options.js').TextOptions} TextOptions */

/** @import { AnyText } from './text.js' */

const MAKING = { makeMaterial: () => new MeshBasicMaterial(), applyMask: applyVectorMask };

/** A text that WebGLRenderer draws. Each option is a property that can be set at any time. */
export class Text extends textOf(MAKING) {}

/** Labels that WebGLRenderer draws in one call, however many there are. */
export class BatchedText extends batchedTextOf(MAKING) {}
