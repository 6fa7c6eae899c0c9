import { CustomBlending, GLSL3, Group, Matrix4, Mesh, OneFactor, OneMinusSrcAlphaFactor, ShaderMaterial, Vector2, Vector3, Vector4 } from 'three';
import { VextureError, line } from '../errors.js';
import { prepareRows, sendRows } from '../rows.js';
import { gradientsAmong } from '../select-root.js';
import { keyOf } from '../tiles/grid.js';
import { Pyramid } from '../tiles/pyramid.js';
import { lookup, paintOf, tileShader } from '../tiles/tile-shader.js';
import { wordTexture } from '../upload.js';
import { cover } from './cover.js';
import { patch } from './patch.js';

/**
 * @typedef {import('../tiles/client.js').LoadedTile} LoadedTile
 * @typedef {import('../tiles/pyramid.js').Feature} Feature
 *
 * @typedef {object} VectorGlobeOptions Data of a globe, and limits of its memory and requests.
 * @property {string | URL | import('../tiles/source.js').TileArchive | import('../tiles/source.js').TileSource} source address of a
 *   `.pmtiles` or a TileJSON, the bytes of a `.pmtiles`, `textureSource` of one texture, or a source of your own
 * @property {number} [radius] 1 by default
 * @property {() => void} [onChange] called when something has been loaded and another frame should be drawn
 * @property {(error: unknown) => void} [onError] called when something cannot be loaded; by default the error is logged
 * @property {number} [budget] bytes of tiles in memory
 * @property {number} [most] number of simultaneous requests
 * @property {number} [retries] number of retries of a failed request
 * @property {number} [pause] milliseconds before the first retry
 */

const VERTEX = `#include <common>
#include <logdepthbuf_pars_vertex>
in vec2 tilePlace;
uniform vec2 tileRest;
uniform float tileScale;
out vec2 tileOffset;
void main() {
    tileOffset = tileRest + tileScale * vec2(tilePlace.x, -tilePlace.y);
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    #include <logdepthbuf_vertex>
}`;

/** Limit in CSS pixels, above the height of any screen, because a much greater height would request all tiles. */
const MOST_HEIGHT = 16384;

/** A tile's colour, which is of sRGB, as three.js's own materials give theirs to the screen or a target. @param {0 | 1 | 2} gradients */
const fragment = (gradients) => `#include <logdepthbuf_pars_fragment>
${tileShader(gradients).replace('void main()', 'void tileMain()')}
#define gl_FragColor tileColor
void main() {
    tileMain();
    tileColor = vextureLight(tileColor);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
    #include <premultiplied_alpha_fragment>
    #include <logdepthbuf_fragment>
}`;

/** A map of `vexture tiles` on a sphere. Call `update(camera, height)` before each frame. */
export class VectorGlobe extends Group {
  #pyramid;
  #radius;
  /** @type {Map<LoadedTile, import('three').DataTexture>} */
  #textures = new Map();
  /** @type {Map<string, { group: Group, loaded: LoadedTile, geometries: import('three').BufferGeometry[] }>} */
  #patches = new Map();

  /**
   * @param {VectorGlobeOptions} options
   * @throws {VextureError} if an option is invalid
   */
  constructor(options) {
    super();
    const { onError = console.error, radius = 1 } = options ?? {};
    if (!Number.isFinite(radius) || radius <= 0) throw new VextureError(`the radius is ${line(radius)}; give a number above 0`, 'radius');
    this.#radius = radius;
    this.#pyramid = new Pyramid({
      ...options,
      onError,
      onDrop: (loaded) => this.#drop(loaded),
    });
  }

  /** Wait for the pyramid's metadata. @returns {Promise<void>} */
  async ready() {
    await this.#pyramid.ready;
  }

  /** Attribution of the data, available after `ready()`, to be shown beside the globe. */
  get attribution() {
    return this.#pyramid.client?.source.attribution ?? '';
  }

  /** Statistics of what it holds and shows. */
  get stats() {
    const { client, shown } = this.#pyramid;
    const quads = shown.map(({ quad, loaded }) => ({ quad, tile: loaded.tile }));
    return { tiles: [...(client?.tiles ?? [])].length, bytes: client?.bytes ?? 0, running: client?.running ?? 0, held: this.#textures.size, shown: quads };
  }

  /**
   * Show what a camera sees, and request missing tiles.
   *
   * @param {import('three').PerspectiveCamera} camera
   * @param {number} height of the picture in CSS pixels
   */
  update(camera, height) {
    checkCamera(camera);
    if (!(height > 0 && height <= MOST_HEIGHT)) {
      throw new VextureError(`the height is ${line(height)}; give that of the picture in pixels, ${MOST_HEIGHT} at most`, 'height');
    }
    this.updateWorldMatrix(true, false);
    camera.updateWorldMatrix(true, false);
    const scale = new Matrix4().makeScale(this.#radius, this.#radius, this.#radius);
    const model = this.matrixWorld.clone().multiply(scale);
    const inverse = model.clone().invert();
    const view = camera.projectionMatrix.clone().multiply(camera.matrixWorld.clone().invert()).multiply(model);
    const position = new Vector3().setFromMatrixPosition(camera.matrixWorld).applyMatrix4(inverse).toArray();
    const pixels = (height * camera.projectionMatrix.elements[5]) / 2;
    const quads = cover({ position: /** @type {import('./cover.js').Vec3} */ (position), planes: planesOf(view), pixels });
    this.#arrange(this.#pyramid.update(quads, (loaded, rows) => {
      const texture = this.#textures.get(loaded);
      if (texture) for (const [first, end] of rows) sendRows(texture, first, Math.min(end, texture.image.height));
    }));
  }

  /**
   * Set colours by the features' ids. A table is merged with earlier tables, and overrides the colours of `setTimes`; a
   * function is called for features that neither colours; null restores the colours of the tiles.
   *
   * @param {import('../tiles/feature-colors.js').FeaturePaints | import('../tiles/feature-colors.js').PaintFunction | null} paints
   * @throws {VextureError} if a colour is invalid
   */
  setPaint(paints) {
    this.#pyramid.colors.setPaint(paints);
  }

  /**
   * Show only some features; others are neither visible nor picked.
   *
   * @param {Iterable<import('../tiles/feature-colors.js').FeatureId> | ((id: string) => boolean) | null} shown ids, or a predicate; null shows all
   */
  setFilter(shown) {
    this.#pyramid.colors.setFilter(shown);
  }

  /**
   * Set the colours of features at each step of time; null removes them. A table of `setPaint` has priority over them, a function has not.
   *
   * @param {import('../tiles/feature-colors.js').TimeTable | null} table
   * @throws {VextureError} if the number of colours of a step differs from that of the ids, or a colour is invalid
   */
  setTimes(table) {
    this.#pyramid.colors.setTimes(table);
  }

  /**
   * Show the colours of `setTimes` at a time.
   *
   * @param {number} time in steps; between two steps colours are mixed
   */
  setTime(time) {
    this.#pyramid.colors.setTime(time);
  }

  /**
   * Find the feature at a place; null if there is none.
   *
   * @param {{ lng: number, lat: number } | [number, number]} place longitude and latitude in degrees
   * @returns {Feature | null}
   * @throws {VextureError} if the place is invalid
   */
  featureAt(place) {
    return this.#pyramid.featureAt(place);
  }

  /**
   * Convert a point of the sphere, such as an intersection of a raycaster, to longitude and latitude.
   *
   * @param {Vector3} point in the world
   * @returns {[number, number]} degrees
   */
  lngLatOf(point) {
    if (!point?.isVector3) throw new VextureError(`the point is ${line(point)}; give a Vector3`, 'point');
    const { x, y, z } = this.worldToLocal(point.clone()).normalize();
    return [(180 / Math.PI) * Math.atan2(x, z), (180 / Math.PI) * Math.asin(Math.min(Math.max(y, -1), 1))];
  }

  /**
   * Find the place under a pointer; null outside the globe.
   *
   * @param {{ x: number, y: number }} pointer -1..1 across the picture, upwards, as for a raycaster
   * @param {import('three').PerspectiveCamera} camera
   * @returns {[number, number] | null} longitude and latitude in degrees
   */
  placeUnder(pointer, camera) {
    const { x, y } = pointer ?? {};
    if (!Number.isFinite(x) || !Number.isFinite(y)) throw new VextureError(`the pointer is ${line(pointer)}; give { x, y }, -1 to 1`, 'pointer');
    checkCamera(camera);
    this.updateWorldMatrix(true, false);
    camera.updateWorldMatrix(true, false);
    const from = this.worldToLocal(new Vector3().setFromMatrixPosition(camera.matrixWorld));
    const way = this.worldToLocal(new Vector3(x, y, 0.5).unproject(camera)).sub(from).normalize();
    const along = from.dot(way);
    const rest = from.clone().addScaledVector(way, -along).lengthSq(); // of the ray from the middle, squared
    const radius = this.#radius;
    if (along > 0 || rest > radius * radius) return null;
    return this.lngLatOf(this.localToWorld(from.addScaledVector(way, -along - Math.sqrt(radius * radius - rest))));
  }

  /**
   * Find the feature under a pointer; null if there is none.
   *
   * @param {{ x: number, y: number }} pointer -1..1 across the picture, upwards, as for a raycaster
   * @param {import('three').PerspectiveCamera} camera
   * @returns {Feature | null}
   */
  featureUnder(pointer, camera) {
    const place = this.placeUnder(pointer, camera);
    return place && this.featureAt(place);
  }

  /** Retry loading tiles or metadata that could not be loaded. */
  retry() {
    this.#pyramid.retry();
  }

  /**
   * Not supported, because a globe loads tiles for its own camera.
   *
   * @returns {never}
   * @throws {VextureError} always
   */
  clone() {
    throw new VextureError('a VectorGlobe cannot be cloned; make another one of the same source', 'clone');
  }

  /** Abort loading, and free the GPU memory. */
  dispose() {
    for (const key of [...this.#patches.keys()]) this.#remove(key);
    this.#pyramid.dispose();
  }

  /** @param {import('../tiles/pyramid.js').View} shown */
  #arrange(shown) {
    const kept = new Set();
    for (const { quad, loaded } of shown) {
      const key = keyOf(quad);
      kept.add(key);
      if (this.#patches.get(key)?.loaded === loaded) continue;
      this.#remove(key);
      this.#add(key, quad, loaded);
    }
    for (const key of [...this.#patches.keys()]) if (!kept.has(key)) this.#remove(key);
  }

  /**
   * @param {string} key
   * @param {import('../tiles/grid.js').TileId} quad
   * @param {LoadedTile} loaded
   */
  #add(key, quad, loaded) {
    const { geometry, skirt, middle } = patch(quad, this.#radius);
    const data = /** @type {import('../data.js').PackedData} */ (loaded.data);
    const group = new Group();
    const { base, rest, side, ends } = lookup(quad, loaded.tile, this.#pyramid.client?.source.margin ?? 0);
    const fragmentShader = fragment(gradientsAmong(data.roots));
    data.roots.forEach((root, order) => {
      const uniforms = {
        vextureTexels: { value: this.#texture(loaded) },
        tileRoot: { value: root.quad },
        tileBase: { value: Uint32Array.from(base) },
        tileRest: { value: new Vector2(...rest) },
        tileEnds: { value: new Vector2(...ends) },
        tileScale: { value: side },
        tilePaint: { value: new Vector4(...paintOf(root)) },
        tileOpacity: { value: 1 },
      };
      const material = new ShaderMaterial({ glslVersion: GLSL3, vertexShader: VERTEX, fragmentShader, uniforms, transparent: true, premultipliedAlpha: true,
        blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor });
      [geometry, skirt].forEach((shape, isSkirt) => {
        const mesh = new Mesh(shape, material);
        mesh.renderOrder = this.renderOrder + (order + isSkirt * data.roots.length) / 65536; // when all that may hide it is there
        group.add(mesh);
      });
    });
    group.position.set(...middle);
    this.add(group);
    this.#patches.set(key, { group, loaded, geometries: [geometry, skirt] });
  }

  /** @param {string} key */
  #remove(key) {
    const known = this.#patches.get(key);
    if (!known) return;
    this.remove(known.group);
    for (const geometry of known.geometries) geometry.dispose();
    for (const mesh of known.group.children) /** @type {any} */ (mesh).material.dispose();
    this.#patches.delete(key);
  }

  /** @param {LoadedTile} loaded */
  #texture(loaded) {
    const known = this.#textures.get(loaded);
    if (known) return known;
    const { texels, width, height } = /** @type {import('../data.js').PackedData} */ (loaded.data);
    const texture = wordTexture(texels, width, height);
    prepareRows(texture);
    this.#textures.set(loaded, texture);
    return texture;
  }

  /** @param {LoadedTile} loaded */
  #drop(loaded) {
    this.#textures.get(loaded)?.dispose();
    this.#textures.delete(loaded);
  }
}

/** @param {any} camera @throws {VextureError} if it is none with a perspective */
function checkCamera(camera) {
  if (!camera?.isPerspectiveCamera) throw new VextureError('the camera is no PerspectiveCamera; give one', 'camera');
}

/**
 * Compute the planes of a frustum, pointing inwards with length 1, except near and far.
 *
 * @param {Matrix4} matrix to clip space
 */
function planesOf({ elements: m }) {
  const row = (/** @type {number} */ k) => [m[k], m[k + 4], m[k + 8], m[k + 12]];
  return [0, 1].flatMap((k) => [1, -1].map((sign) => {
    const plane = row(3).map((part, c) => part + sign * row(k)[c]);
    const length = Math.hypot(plane[0], plane[1], plane[2]);
    return plane.map((part) => part / length);
  }));
}
