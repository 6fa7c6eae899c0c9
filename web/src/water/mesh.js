// Common to all kinds of water: a mesh with a shape that changes with time.
import { VextureError, line } from '../errors.js';
import { FIELDS, WaterFields } from './fields.js';
import { FOLD } from './shader.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */
/** @typedef {import('./shape.js').WaterShape} WaterShape */
/** @typedef {import('../fold-texture.js').FoldTexture} FoldTexture */
/** @typedef {import('three').ColorRepresentation} ColorRepresentation */
/** @typedef {import('three').Mesh<import('three').BufferGeometry, import('three').ShaderMaterial>} WaterMesh */

/**
 * @typedef {object} WaterOptions What all kinds of water take.
 * @property {FoldTexture | null} [fold] moves the shore; by default none
 * @property {import('three').Texture | null} [fields] over the mesh's uv; red: metres of depth, green: how open it is
 * @property {import('./fields.js').Calm} [calm] colours and clearness of calm water
 * @property {import('./fields.js').DepthColors | null} [depthColors] colours of depths instead of the look of water, where fields
 *   give depths; by default none
 */

/** Colours of the sea by day; three.js's defaults are grey. */
export const SEA = Object.freeze({ waterColor: 0x0b5068, sunColor: 0x9fb0b8 });

/**
 * @param {import('three').BufferGeometry} geometry
 * @throws {VextureError} if it has no uv
 */
export function checkGeometry(geometry) {
  if (geometry?.getAttribute?.('uv')) return;
  throw new VextureError(
    `the water's geometry is ${line(geometry?.type)} without the attribute uv; use a PlaneGeometry`,
    'geometry',
  );
}

/**
 * Do something while a mesh stands at the height that it mirrors at.
 *
 * @param {import('three').Object3D & {mirrorHeight: number}} mesh
 * @param {() => void} act
 */
function raised({ matrixWorld: { elements }, mirrorHeight }, act) {
  const normal = elements.slice(8, 11);
  const length = Math.hypot(...normal) || 1;
  const before = elements.slice(12, 15);
  before.forEach((place, at) => (elements[12 + at] = place + (normal[at] / length) * mirrorHeight));
  act();
  before.forEach((place, at) => (elements[12 + at] = place));
}

/**
 * Extend a class of meshes with the properties of water.
 *
 * @template {new (...args: any[]) => WaterMesh} Base
 * @param {Base} base
 */
export function watered(base) {
  return class extends base {
    /** @internal @type {WaterShape} */
    shape = /** @type {any} */ (null); // made by the subclass
    /** @internal @type {import('three').Texture | null} */
    ownNormals = null; // those that this water made
    /** @internal @type {FoldTexture | null} */
    ownFold = null;
    /** @internal @type {WaterFields} */
    ownFields = new WaterFields();
    /** Distance from the mesh's plane of the plane that it mirrors, in world units along its normal. */
    mirrorHeight = 0;

    /** The texture with the water's shape; null: no water. Setting it ends a fade. */
    get texture() {
      return this.shape.texture;
    }

    set texture(texture) {
      this.shape.texture = texture;
    }

    /** The texture passed to `fadeTo`; null without a fade. */
    get next() {
      return this.shape.next;
    }

    /**
     * Prepare a fade to another texture, or to no water (null). A fade in progress jumps to the nearer of its ends.
     *
     * @param {VectorTexture | null} texture
     */
    fadeTo(texture) {
      this.shape.fadeTo(texture);
    }

    /** Progress of the fade, 0 to 1. At 1 the next texture is shown; setting a smaller value goes back. */
    get fade() {
      return this.shape.fade;
    }

    set fade(fade) {
      this.shape.fade = fade;
    }

    /** The fold that moves the shore, or null. Water with and without a fold are different programs. */
    get fold() {
      return this.ownFold;
    }

    set fold(/** @type {FoldTexture | null} */ fold) {
      if (fold && !fold.isFoldTexture) {
        throw new VextureError(`fold is ${line(fold)}; load one by FoldTexture.parse`, 'fold');
      }
      const { uniforms, defines } = this.material;
      if (Boolean(fold) !== FOLD in defines) this.material.needsUpdate = true;
      if (fold) defines[FOLD] = '';
      else delete defines[FOLD];
      this.ownFold = fold;
      uniforms.vextureFolding.value = fold?.texture ?? null;
      uniforms.vextureCycle.value = fold?.cycle ?? 0;
      this.time = this.time;
    }

    /**
     * Texture over the mesh's uv, or null. Red: metres of depth. Green: how open the water is, from 1 where there are waves
     * and foam to 0 where it is calm. Water with and without fields are different programs.
     */
    get fields() {
      return this.ownFields.uniforms.vextureFields.value;
    }

    set fields(/** @type {import('three').Texture | null} */ fields) {
      if (fields && !fields.isTexture) throw new VextureError(`fields is ${line(fields)}; it must be a Texture`, 'fields');
      const { defines } = this.material;
      if (Boolean(fields) !== FIELDS in defines) this.material.needsUpdate = true;
      if (fields) defines[FIELDS] = '';
      else delete defines[FIELDS];
      this.ownFields.uniforms.vextureFields.value = fields;
    }

    /** Colours and transparency of calm water, where fields mark it as calm. */
    get calm() {
      return this.ownFields.calm;
    }

    set calm(/** @type {import('./fields.js').Calm} */ calm) {
      this.ownFields.calm = calm;
    }

    /** Colours of depths instead of the look of water, where fields give depths; null: none. */
    get depthColors() {
      return this.ownFields.colors;
    }

    set depthColors(/** @type {import('./fields.js').DepthColors | null} */ colors) {
      this.ownFields.colors = colors;
    }

    /** Time of the waves and the fold, in seconds. */
    get time() {
      return this.material.uniforms.time.value;
    }

    set time(/** @type {number} */ seconds) {
      this.material.uniforms.time.value = seconds;
      this.material.uniforms.vextureTime.value = this.ownFold?.clock(seconds) ?? 0;
    }

    /** The foam along the shore. */
    get foam() {
      return this.shape.foam;
    }

    set foam(/** @type {import('./shape.js').Foam} */ foam) {
      this.shape.foam = foam;
    }

    /** Colour of the water on the shore, or null. */
    get shallow() {
      return this.shape.shallow;
    }

    set shallow(/** @type {ColorRepresentation | null} */ color) {
      this.shape.shallow = color;
    }

    /** The uniform colour of the water, or null. */
    get flat() {
      return this.shape.flat;
    }

    set flat(/** @type {ColorRepresentation | null} */ color) {
      this.shape.flat = color;
    }

    /**
     * Take the options that all kinds of water have, and update the shape's rasters before each frame. The subclass calls
     * this once `shape` is set.
     *
     * @internal
     * @param {import('./mesh.js').WaterOptions} options
     */
    follow({ fold = null, fields = null, calm = {}, depthColors = null }) {
      Object.assign(this.material.uniforms, this.ownFields.uniforms);
      Object.assign(this, { fold, fields, calm, depthColors });
      const before = this.onBeforeRender;
      /** @type {typeof before} */
      this.onBeforeRender = (renderer, scene, camera, ...others) => {
        this.shape.prepare(renderer);
        const { viewport } = /** @type {import('three').PerspectiveCamera} */ (camera);
        if (viewport) renderer.state.viewport(viewport);
        raised(this, () => before.call(this, renderer, scene, camera, ...others));
      };
    }

    /** Free the water's own GPU memory; textures and geometry stay, because others may use them. */
    dispose() {
      this.shape.dispose();
      this.ownNormals?.dispose();
      const mirror = /** @type {any} */ (this.material.uniforms.mirrorSampler?.value);
      mirror?.renderTarget?.dispose(); // older versions of three.js do not link it to the mesh
      this.material.dispose();
    }
  };
}
