import { MeshBasicNodeMaterial } from 'three/webgpu';
import { glyphHooks } from '../glyph-hooks.js';
import { batchedTextOf } from '../text/batched-text.js';
import { textOf } from '../text/text.js';
import { glyphNodes } from './glyph-nodes.js';
import { applyVectorMask } from './vector-node-mask.js';

/** @import { AnyText } from '../text/text.js' */

const MAKING = { makeMaterial: () => /** @type {any} */ (new MeshBasicNodeMaterial()), applyMask: applyNodeMask };

/** @type {typeof applyVectorMask} */
function applyNodeMask(...of) {
  glyphHooks.nodes = glyphNodes; // what masks of other meshes need not load
  return applyVectorMask(...of);
}

/** A text that WebGPURenderer draws; see `vexture/text`. */
export class Text extends textOf(MAKING) {}

/** Labels that WebGPURenderer draws in one call, however many there are; see `vexture/text`. */
export class BatchedText extends batchedTextOf(MAKING) {}
