// Many labels in one draw call, whatever the renderer.
import { DoubleSide, Mesh, Quaternion, Ray, Vector3 } from 'three';
import { VextureError, givenOptions, line } from '../errors.js';
import { VIEWPORT, installGlyphShader } from '../glyph-shader.js';
import { AtlasFont } from './atlas-font.js';
import { weightOf } from './faces.js';
import { Glyphs } from './glyphs.js';
import { LabelGeometry } from './label-geometry.js';
import { LabelTable } from './label-table.js';
import { Label } from './label.js';
import { chosen, glyphAt } from './layout.js';
import { LAYOUT, checkOption, inksOf, requestOf } from './text-options.js';
import { isUpright, readViewport } from './viewport.js';
import { reportOnce, warnOf } from './warnings.js';

/** @import { Material } from 'three' */
/** @import { LabelOptions } from './label.js' */
/** @import { TextLayout } from './layout.js' */
/** @import { TextMaking } from './text.js' */
/** @import { LayoutOptions } from './text-options.js' */

/**
 * @typedef {object} BatchOptions Options of all labels besides those of their layout, which are the defaults of each.
 * @property {boolean} [sprites] whether labels face the camera; false by default
 * @property {boolean} [pixels] whether the unit of lengths is a pixel of the screen; false by default
 * @property {Material | null} [material] copied; by default an unlit one
 * @property {Glyphs} [glyphs] by default those of the page
 */

/** Outlines and strokes are layers of their own. */
const SINGLE = Object.freeze(['outlineWidth', 'strokeWidth']);

/** Labels whose texts are set by one message. */
const AT_ONCE = 1000;

const RAY = new Ray(),
  TURN = new Quaternion(),
  HIT = new Vector3(),
  CENTRE = new Vector3();

/**
 * The class of labels of a renderer.
 *
 * @param {TextMaking} making
 */
export function batchedTextOf({ makeMaterial, applyMask }) {
  installGlyphShader();
  return class BatchedText extends Mesh {
    #defaults;
    #glyphs;
    #table;
    #boxOf;
    #unfollow;
    /** It is held here, and nowhere else: glyphs do not keep labels alive. @type {import('./glyphs.js').GlyphUser} */
    #user;
    /** @type {Map<number, Label>} by row */
    #labels = new Map();
    /** @type {number[]} */
    #freeRows = [];
    /** @type {Set<Label>} */
    #stale = new Set();
    /** @type {Promise<void> | null} */
    #syncing = null;
    /** Labels in colours of their own; made when there are any. @type {Mesh | null} */
    #colored = null;
    #makeMesh;
    /** Labels with emoji that have parts in the label's colour, and that colour. @type {Map<Label, string>} */
    #inked = new Map();
    /** Pixels of the picture from its bottom to its top. */
    #height = 1;

    /** @param {Partial<LayoutOptions> & BatchOptions} [options] */
    constructor(options) {
      const { sprites = false, pixels = false, material = null, glyphs = Glyphs.shared, ...layout } = givenOptions(options);
      for (const [name, value] of Object.entries(layout)) {
        if (!(name in LAYOUT)) throw new VextureError(`labels have no option ${line(name)}; correct its name`, name);
        if (SINGLE.includes(name) && value) throw new VextureError(`labels have no ${name}; show what needs one as a Text`, name);
        checkOption(name, value);
      }
      const table = new LabelTable(sprites, pixels);
      const flat = sprites; // each is parallel to the picture, though not all are at the same depth
      const masked = (/** @type {'alpha' | 'paint'} */ mode) => {
        const own = material ? material.clone() : Object.assign(makeMaterial(), { side: DoubleSide, depthWrite: false, transparent: true, forceSinglePass: true });
        const mask = applyMask(own, glyphs.texture, { instanced: table, mode, flat, background: mode === 'paint' ? 'none' : undefined });
        return Object.assign(own, { userData: { ...own.userData, mask } });
      };
      super(new LabelGeometry(), masked('alpha'));
      /** @type {any} */ (this.material).userData.mask.attach(this); // its shadow is that of letters
      /** Labels are anywhere. @internal */
      this.frustumCulled = false; // labels are anywhere
      this.#defaults = { ...LAYOUT, ...layout };
      this.#glyphs = glyphs;
      this.#table = table;
      this.#boxOf = (/** @type {number} */ shape) => glyphs.texture.boxes[shape];
      this.#makeMesh = () => {
        const mesh = new Mesh(new LabelGeometry(), masked('paint'));
        /** @type {any} */ (mesh.material).userData.mask.attach(mesh);
        return Object.assign(mesh, { frustumCulled: false, raycast: () => {} });
      };
      this.#user = { shapesInUse: () => this.#shapesInUse(), renumber: (places) => this.#renumber(places) };
      this.#unfollow = glyphs.follow(this.#user);
    }

    /** The labels. */
    get labels() {
      return this.#labels.values();
    }

    /** The worker and the texture of the glyphs. */
    get glyphs() {
      return this.#glyphs;
    }

    /**
     * Add a label.
     *
     * @param {Partial<LayoutOptions> & LabelOptions} [options]
     * @returns {Label}
     */
    addLabel(options = {}) {
      const row = this.#freeRows.pop() ?? this.#labels.size;
      const label = new Label(row, (stale) => this.#markStale(stale));
      this.#labels.set(row, label);
      this.#markStale(label);
      label.set(options);
      if (this.#table.makeRoom(row + 1)) this.#glyphs.texture.dispatchEvent({ type: 'change' }); // masks take the table's other texture
      return label;
    }

    /** Remove a label. @param {Label} label */
    removeLabel(label) {
      if (this.#labels.get(label.row) !== label) return;
      this.#labels.delete(label.row);
      this.#stale.delete(label);
      this.#inked.delete(label);
      this.#freeRows.push(label.row);
      this.#show(label, null);
    }

    /** @param {Label} label */
    #markStale(label) {
      if (!this.#stale.size) queueMicrotask(() => this.sync().catch(() => {})); // the event tells
      this.#stale.add(label);
    }

    /**
     * Show all labels as their options say. It is done by itself after a change; this tells when.
     *
     * @returns {Promise<void>}
     * @throws {VextureError} if one cannot be set; the others are shown
     */
    sync() {
      this.#syncing ??= this.#syncWhileStale().finally(() => {
        this.#syncing = null;
      });
      return this.#syncing;
    }

    async #syncWhileStale() {
      /** @type {unknown} */
      let problem = null;
      while (this.#stale.size) {
        const labels = [...this.#stale].slice(0, AT_ONCE);
        for (const label of labels) this.#stale.delete(label);
        const outcomes = await Promise.allSettled(labels.map((label) => this.#layout(label)));
        outcomes.forEach((outcome, place) => {
          const label = labels[place];
          label.error = outcome.status === 'rejected' ? outcome.reason : null;
          if (outcome.status === 'rejected') problem = outcome.reason;
          else if (this.#labels.get(label.row) === label && !this.#stale.has(label)) this.#show(label, outcome.value);
          if (outcome.status === 'fulfilled' && outcome.value) warnOf(outcome.value);
        });
        /** @type {LabelGeometry} */ (this.geometry).compact(this.#boxOf);
      }
      if (!problem) return void this.dispatchEvent(/** @type {any} */ ({ type: 'synccomplete' }));
      const message = problem instanceof Error ? problem.message : String(problem);
      this.dispatchEvent(/** @type {any} */ ({ type: 'error', message }));
      reportOnce(message);
      throw problem;
    }

    /** @param {Label} label @returns {Promise<TextLayout | null>} */
    async #layout(label) {
      const options = { ...this.#defaults, ...label.options };
      const { font } = options;
      if (font instanceof AtlasFont) throw new VextureError('labels are not set in a baked font; give the address of a font', 'font');
      if (!options.text) return null;
      const inks = inksOf(label.color);
      const layout = await this.#glyphs.typeset({ ...requestOf(options), inks }, { font, weight: weightOf(options.fontWeight), isItalic: options.fontStyle === 'italic' });
      if (layout.hasInk) this.#inked.set(label, inks[0][1]);
      else this.#inked.delete(label);
      return layout;
    }

    /** @param {Label} label @param {TextLayout | null} layout */
    #show(label, layout) {
      label.layout = layout;
      const { roots } = this.#glyphs.texture;
      const isMap = (/** @type {number} */ shape) => roots[shape].isMap;
      const glyphs = layout ?? { shapes: new Uint32Array(0), places: new Float32Array(0), clusters: new Uint32Array(0) };
      const hasMaps = glyphs.shapes.some(isMap);
      if (hasMaps && !this.#colored) {
        this.#colored = this.#makeMesh();
        this.add(this.#colored);
      }
      const geometry = /** @type {LabelGeometry} */ (this.geometry);
      geometry.setLabel(label.row, hasMaps ? chosen(glyphs, (shape) => !isMap(shape)) : glyphs, this.#boxOf);
      if (this.#colored) /** @type {LabelGeometry} */ (this.#colored.geometry).setLabel(label.row, chosen(glyphs, isMap), this.#boxOf);
    }

    *#shapesInUse() {
      for (const { layout } of this.#labels.values()) if (layout) yield* layout.shapes;
    }

    /** @param {ReadonlyMap<number, number>} places */
    #renumber(places) {
      for (const label of this.#labels.values()) {
        const { layout } = label;
        if (!layout) continue;
        if (layout.shapes.some((shape) => !places.has(shape))) this.#markStale(label);
        else {
          layout.shapes = layout.shapes.map((shape) => /** @type {number} */ (places.get(shape)));
          this.#show(label, layout);
        }
      }
    }

    /** What three.js calls before it sorts what it draws: emoji follow the labels. @internal @param {boolean} [force] */
    updateMatrixWorld(force) {
      if (this.#colored) {
        const { renderOrder, castShadow, receiveShadow, layers } = this;
        Object.assign(this.#colored, { renderOrder, castShadow, receiveShadow }).layers.mask = layers.mask;
      }
      super.updateMatrixWorld(force);
    }

    /** What three.js calls before it draws shadows, which is before the labels themselves. @internal */
    onBeforeShadow() {
      this.#table.update(this.#labels.values());
    }

    /** What three.js calls before each frame. @internal @param {any} renderer @param {any} _scene @param {any} camera */
    onBeforeRender(renderer, _scene, camera) {
      readViewport(renderer);
      this.#height = VIEWPORT.y;
      this.#table.update(this.#labels.values());
      for (const [label, ink] of this.#inked) if (inksOf(label.color)[0][1] !== ink) this.#markStale(label);
      // labels that are parallel to the picture are seen straight, though not all from the same distance
      const flat = this.#table.areSprites || (!this.#table.hasTurns && isUpright(this, camera));
      for (const mesh of [this, this.#colored]) {
        const mask = /** @type {any} */ (mesh?.material)?.userData.mask;
        if (mask && mask.flat !== flat) mask.set({ flat });
      }
    }

    /**
     * Meet a ray: an intersection is anywhere in the block of a label, which is its `label`.
     *
     * @param {import('three').Raycaster} raycaster
     * @param {import('three').Intersection[]} hits
     */
    raycast(raycaster, hits) {
      for (const label of this.#labels.values()) {
        const { layout } = label;
        if (!layout || !label.visible) continue;
        CENTRE.copy(label.position).applyMatrix4(this.matrixWorld);
        const size = label.scale * this.#unitAt(CENTRE, raycaster);
        this.matrixWorld.decompose(new Vector3(), TURN, new Vector3());
        if (this.#table.areSprites) raycaster.camera.getWorldQuaternion(TURN);
        else TURN.multiply(label.quaternion);
        RAY.copy(raycaster.ray);
        RAY.origin.sub(CENTRE).applyQuaternion(TURN.conjugate()).divideScalar(size);
        RAY.direction.applyQuaternion(TURN);
        const distance = -RAY.origin.z / RAY.direction.z;
        if (!(distance > 0)) continue;
        RAY.at(distance, HIT);
        const [left, bottom, right, top] = layout.blockBounds;
        if (HIT.x < left || HIT.x > right || HIT.y < bottom || HIT.y > top) continue;
        const far = distance * size;
        if (far < raycaster.near || far > raycaster.far) continue;
        const glyph = glyphAt(layout, this.#glyphs.texture.boxes, HIT.x, HIT.y);
        const point = raycaster.ray.at(far, new Vector3());
        hits.push(/** @type {any} */ ({ distance: far, point, object: this, label, charIndex: glyph < 0 ? -1 : layout.clusters[glyph] }));
      }
    }

    /** Length of a label's unit at a point of the world. @param {Vector3} at @param {import('three').Raycaster} raycaster */
    #unitAt(at, { camera }) {
      const own = this.#table.areSprites ? 1 : this.matrixWorld.getMaxScaleOnAxis();
      if (!this.#table.arePixels) return own;
      const { elements } = /** @type {any} */ (camera).projectionMatrix;
      const depth = elements[15] === 1 ? 1 : -at.clone().applyMatrix4(camera.matrixWorldInverse).z;
      return (2 * depth) / (this.#height * elements[5]);
    }

    /** Labels are not copied. @internal @returns {any} */
    copy() {
      throw new VextureError('labels are not copied; make another BatchedText, and add labels to it', 'copy');
    }

    /** Free the GPU memory. */
    dispose() {
      this.#unfollow();
      for (const mesh of [this, this.#colored]) {
        mesh?.geometry.dispose();
        /** @type {Material | undefined} */ (mesh?.material)?.dispose();
      }
      this.#table.texture.dispose();
    }
  };
}
