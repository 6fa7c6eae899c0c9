// The parts of a text: meshes of glyphs, and how they look.
import { DoubleSide, Mesh } from 'three';
import { GlyphGeometry } from './glyph-geometry.js';
import { isUpright, readViewport } from './viewport.js';

/** @import { Material } from 'three' */

/** Steps between the render orders of the parts of a text. */
const STEP = 2 ** -12;

/** A part of a text: its letters, what is around them, or glyphs in colours of their own. */
export class Part extends Mesh {
  /** @param {Material} material */
  constructor(material) {
    super(new GlyphGeometry(), material);
    this.raycast = () => {}; // that of the text finds its parts
    Object.assign(this, { isTextPart: true });
    material.userData.mask.attach(this); // its shadow is that of letters
  }

  /** Be drawn as its text is. @param {Mesh} text @param {boolean} isBehind */
  follow(text, isBehind) {
    this.renderOrder = text.renderOrder + (isBehind ? -STEP : STEP);
    this.layers.mask = text.layers.mask;
    this.castShadow = text.castShadow;
    this.receiveShadow = text.receiveShadow;
  }

  /** @param {any} renderer @param {any} _scene @param {any} camera */
  onBeforeRender(renderer, _scene, camera) {
    beforeDrawing(this, renderer, camera);
  }
}

/**
 * Take the size of the picture, and the cheaper method where a text is seen straight.
 *
 * @param {any} mesh
 * @param {any} renderer
 * @param {any} camera
 */
export function beforeDrawing(mesh, renderer, camera) {
  readViewport(renderer);
  const { mask } = mesh.material.userData, { isBent } = mesh.geometry;
  const flat = !isBent && isUpright(mesh, camera);
  if (mask.options.flat !== flat) mask.set({ flat });
}

/** Prepare a material of ours: the squares of neighbours overlap, so that depth is not written. @param {any} material */
export function usual(material) {
  return Object.assign(material, { side: DoubleSide, depthWrite: false, transparent: true, forceSinglePass: true });
}

/**
 * Set how a part looks.
 *
 * @param {any} material
 * @param {any} color null: as it is
 * @param {number} opacity
 * @param {number} depthOffset
 */
export function paint(material, color, opacity, depthOffset) {
  if (color !== null) material.color?.set(color);
  material.opacity = opacity;
  material.polygonOffset = depthOffset !== 0;
  material.polygonOffsetFactor = material.polygonOffsetUnits = depthOffset;
}
