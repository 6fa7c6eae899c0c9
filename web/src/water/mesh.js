// What all kinds of water are, whatever they look like: a mesh with a shape, in time.
import { VextureError, line } from '../errors.js';
import { FOLD } from './shader.js';

/** @typedef {import('../vector-texture.js').VectorTexture} VectorTexture */
/** @typedef {import('./shape.js').WaterShape} WaterShape */
/** @typedef {import('../fold-texture.js').FoldTexture} FoldTexture */
/** @typedef {import('three').ColorRepresentation} ColorRepresentation */
/** @typedef {import('three').Mesh<import('three').BufferGeometry, import('three').ShaderMaterial>} WaterMesh */

/** Colours of the sea by day, unlike three.js' greys. */
export const SEA = Object.freeze({ waterColor: 0x0b5068, sunColor: 0x9fb0b8 });

/**
 * @param {import('three').BufferGeometry} geometry
 * @throws {VextureError} if water cannot be on it
 */
export function checkGeometry(geometry) {
  if (geometry?.getAttribute?.('uv')) return;
  throw new VextureError(
    `the water's geometry is ${line(geometry?.type)} without the attribute uv; use a PlaneGeometry`,
    'geometry',
  );
}

/**
 * A class of meshes, as water.
 *
 * @template {new (...args: any[]) => WaterMesh} Base
 * @param {Base} base
 */
export function watered(base) {
  return class extends base {
    /** @type {WaterShape} which its class makes */
    shape = /** @type {any} */ (null);
    /** @type {import('three').Texture | null} waves that nobody else has */
    ownNormals = null;
    /** @type {FoldTexture | null} */
    ownFold = null;

    /** Where the water is: a texture, or null for no water at all. To set it ends a fade. */
    get texture() {
      return this.shape.texture;
    }

    set texture(texture) {
      this.shape.texture = texture;
    }

    /** What `fadeTo` was given; null too while there is no fade. */
    get next() {
      return this.shape.next;
    }

    /**
     * Make another texture ready to fade to, or null, no water. A fade in progress becomes the nearer of its two ends.
     *
     * @param {VectorTexture | null} texture
     */
    fadeTo(texture) {
      this.shape.fadeTo(texture);
    }

    /** How far the water has become what `fadeTo` was given, 0 to 1. At 1 it is that, and can still go back. */
    get fade() {
      return this.shape.fade;
    }

    set fade(fade) {
      this.shape.fade = fade;
    }

    /** What moves the shore with time, or null. With one and without are two programs. */
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

    /** Seconds: where the waves and the fold are. */
    get time() {
      return this.material.uniforms.time.value;
    }

    set time(/** @type {number} */ seconds) {
      this.material.uniforms.time.value = seconds;
      this.material.uniforms.vextureTime.value = this.ownFold?.clock(seconds) ?? 0;
    }

    /** The strip along the shore. */
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

    /** The one colour of all the water, or null. */
    get flat() {
      return this.shape.flat;
    }

    set flat(/** @type {ColorRepresentation | null} */ color) {
      this.shape.flat = color;
    }

    /** Be ready for the shape before each picture; its class calls this when `shape` is there. */
    follow() {
      const before = this.onBeforeRender;
      /** @type {typeof before} */
      this.onBeforeRender = (renderer, scene, camera, ...others) => {
        this.shape.prepare(renderer);
        const { viewport } = /** @type {import('three').PerspectiveCamera} */ (camera);
        if (viewport) renderer.state.viewport(viewport);
        before.call(this, renderer, scene, camera, ...others);
      };
    }

    /** Free what the GPU holds for this water; textures and geometry stay, others may use them. */
    dispose() {
      this.shape.dispose();
      this.ownNormals?.dispose();
      const mirror = /** @type {any} */ (this.material.uniforms.mirrorSampler?.value);
      mirror?.renderTarget?.dispose(); // older ones of three.js have no way from one to the other
      this.material.dispose();
    }
  };
}
