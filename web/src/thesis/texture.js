import { DataTexture, FloatType, RGBAFormat } from 'three';
import { CURVE_WIDTH, QUAD_WIDTH } from '../../generated/thesis-layout.js';
import { FOLD_HEIGHT } from '../../generated/thesis-shader.js';
import { VextureError } from '../errors.js';
import { unfiltered } from '../upload.js';
import { VectorTexture } from '../vector-texture.js';
import { thesisFunctions } from './shader.js';
import { containsThesis } from './walk.js';

/** @typedef {import('./read.js').ThesisData} ThesisData */

/**
 * Texture with one list of a thesis texture as numbers in 0..1; row r goes to row r % height, in block r / height.
 *
 * @param {Uint8Array | Uint16Array} pixels RGB
 * @param {number} width pixels in a row
 * @param {number} most rows of the texture
 */
export function listTexture(pixels, width, most) {
  const rows = pixels.length / (3 * width);
  const height = Math.min(rows, most);
  const across = Math.ceil(rows / most) * width;
  const one = 256 ** pixels.BYTES_PER_ELEMENT - 1;
  const numbers = new Float32Array(4 * across * height);
  for (let row = 0; row < rows; row++) {
    const start = 4 * ((row % most) * across + Math.floor(row / most) * width);
    for (let i = 0; i < 3 * width; i++) {
      numbers[start + 4 * Math.floor(i / 3) + (i % 3)] = pixels[3 * width * row + i] / one;
    }
  }
  return unfiltered(new DataTexture(numbers, across, height, RGBAFormat, FloatType), 'RGBA32F');
}

/**
 * The only shape of a thesis texture; a mask shows it without wrap, instances and fold.
 *
 * @extends {VectorTexture<ThesisData>}
 */
export class ThesisTexture extends VectorTexture {
  /**
   * Whether a point of the unit square is inside the shape.
   *
   * @override
   * @param {number} u
   * @param {number} v upwards
   * @param {import('../select-root.js').RootChoice} [root] 0 or the texture's name; not needed
   * @returns {boolean}
   */
  contains(u, v, root) {
    this.index(root);
    return containsThesis(this.data, u, v);
  }

  /**
   * A thesis texture has one shape, and no layers.
   *
   * @override
   * @throws {VextureError} always
   * @returns {never}
   */
  layersOf() {
    throw new VextureError(`${this.name}: a thesis texture has no layers; convert the drawing to KTX2`, 'encoding');
  }

  /**
   * @override
   * @protected
   * @param {ThesisData} data
   * @returns {import('../vector-texture.js').TextureMap}
   */
  upload(data) {
    return {
      quads: listTexture(data.quads, QUAD_WIDTH, FOLD_HEIGHT),
      curves: listTexture(data.curves, CURVE_WIDTH, FOLD_HEIGHT),
    };
  }

  /**
   * @internal
   * @override
   * @returns {import('../vector-texture.js').MaskReader}
   */
  maskReader() {
    const lists = 'precision highp sampler2D;\nuniform sampler2D vextureQuads;\nuniform sampler2D vextureCurves;\n';
    return {
      declared: lists + thesisFunctions(this.data),
      coverage: (footprint) => `thesis_coverage(vextureQuads, vextureCurves, ${footprint})`,
      uniforms: {
        vextureQuads: this.textures.quads,
        vextureCurves: this.textures.curves,
        thesis_list_lengths: [this.data.quadCount, this.data.curveCount],
      },
    };
  }
}
