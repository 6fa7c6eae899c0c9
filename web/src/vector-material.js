import { MeshBasicMaterial } from 'three';
import { shapeMaterial } from './shape-material.js';
import { VectorMask } from './vector-mask.js';

/** @typedef {import('./shape-material.js').VectorMaterialParameters} VectorMaterialParameters */

/**
 * An unlit material that shows a shape in one colour, or a drawing in its own colours. Fog, tone mapping, colour space,
 * logarithmic depth, clipping and skinning work as in `MeshBasicMaterial`. Each option is a property that can be set at
 * any time, even before there is a texture; `setValues` changes several, or none after an error. Use `applyVectorMask`
 * for other materials.
 */
export class VectorMaterial extends shapeMaterial(MeshBasicMaterial, VectorMask, 'VectorMaterial') {}
