// A text in a three.js scene, whatever its renderer.
import { Color, Matrix4, Mesh, Object3D, Ray, Vector3 } from 'three';
import { VextureError, givenOptions, line } from '../errors.js';
import { installGlyphShader } from '../glyph-shader.js';
import { AriaMirror } from './aria-mirror.js';
import { AtlasFont } from './atlas-font.js';
import { alongCurve, isBent, onCylinder } from './bends.js';
import { weightOf } from './faces.js';
import { GlyphGeometry } from './glyph-geometry.js';
import { Glyphs } from './glyphs.js';
import { NOTHING, chosen } from './layout.js';
import { meetText } from './rays.js';
import { ARRANGEMENT, DEFAULTS, LAYOUT, checkOption, inksOf, lengthOf, requestOf } from './text-options.js';
import { Part, beforeDrawing, paint, usual } from './text-parts.js';
import { reportOnce, warnOf } from './warnings.js';

/** @import { Material } from 'three' */
/** @import { PlacedShapes, TextLayout } from './layout.js' */
/** @import { TextOptions } from './text-options.js' */

/**
 * @typedef {object} TextMaking How the texts of a renderer are made.
 * @property {() => Material} makeMaterial an unlit material
 * @property {(material: Material, texture: any, options: import('../mask-options.js').MaskOptions) => any} applyMask
 *
 * @typedef {object} TextProperties What a text has besides its options.
 * @property {Glyphs} glyphs the worker and the texture, by default those of the page
 * @property {TextLayout | null} layout measures and places of what is shown; null: nothing yet
 * @property {Error | null} error why the last change is not shown
 * @property {(callback?: () => void) => Promise<void>} sync resolves when the text is shown as its options say
 * @property {() => void} dispose frees the GPU memory
 *
 * @typedef {Mesh & TextOptions & TextProperties} AnyText
 */

const RAY = new Ray(),
  INVERSE = new Matrix4();

/**
 * The class of texts of a renderer.
 *
 * @param {TextMaking} making
 * @returns {new (options?: Partial<TextOptions> & { material?: Material | null, glyphs?: Glyphs }) => AnyText}
 */
export function textOf({ makeMaterial, applyMask }) {
  installGlyphShader();
  class Text extends Mesh {
    /** @type {TextOptions} */
    #options = { ...DEFAULTS };
    /** @type {Material | null} */
    #base = null;
    /** @type {Map<string, Part>} parts besides the letters, by their name */
    #parts = new Map();
    /** @type {TextLayout | null} */
    #layout = null;
    /** @type {Promise<void> | null} */
    #syncing = null;
    #isStale = false;
    #mirror = new AriaMirror();
    /** @type {AtlasFont | null} */
    #atlas = null;
    /** @type {any} */ #glyphs;
    /** @type {any} */ #unfollow;
    /** It is held here, and nowhere else: glyphs do not keep texts alive. @type {import('./glyphs.js').GlyphUser} */
    #user;
    /** @type {Error | null} */
    error = null;

    /** @param {Partial<TextOptions> & { material?: Material | null, glyphs?: Glyphs }} [options] */
    constructor(options) {
      const { material = null, glyphs = Glyphs.shared, ...others } = givenOptions(options);
      super(new GlyphGeometry(), /** @type {any} */ (undefined));
      this.#user = { shapesInUse: () => this.#shapesInUse(), renumber: (places) => this.#renumber(places) };
      this.#take(glyphs);
      this.#setBase(material);
      for (const [name, value] of Object.entries(others)) {
        if (!(name in DEFAULTS)) throw new VextureError(`a text has no option ${line(name)}; correct its name`, name);
        /** @type {any} */ (this)[name] = value;
      }
    }

    /** @param {Glyphs} glyphs */
    #take(glyphs) {
      this.#unfollow?.();
      this.#glyphs = glyphs;
      this.#unfollow = glyphs.follow(this.#user);
    }

    get isText() {
      return true;
    }

    get glyphs() {
      return this.#glyphs;
    }

    get layout() {
      return this.#layout;
    }

    /** The material of the letters: a copy of the one that was given. Set another one to show them by it. */
    // @ts-expect-error three.js has a field
    get material() {
      return this.#material;
    }

    set material(material) {
      if (#glyphs in this) this.#setBase(material); // the constructor of three.js sets one before
    }

    /** @type {any} */
    #material;

    /** @param {Material | null} base */
    #setBase(base) {
      this.#base = base;
      this.#material?.userData.mask.detach(this);
      this.#material?.dispose();
      this.#material = this.#masked('letters');
      this.#material.userData.mask.attach(this); // its shadow is that of letters
      for (const name of this.#parts.keys()) this.#removePart(name);
      if (this.#layout?.hasInk) this.#markStale();
      this.#arrange();
    }

    /** @param {string} part @returns {Material} */
    #masked(part) {
      const material = this.#base ? this.#base.clone() : usual(makeMaterial());
      const isColored = part === 'colored';
      if (isColored && 'color' in material) /** @type {any} */ (material).color = new Color(0xffffff);
      const mask = applyMask(material, this.#shapes.texture, {
        instanced: 'glyphs', mode: isColored ? 'paint' : 'alpha', background: isColored ? 'none' : undefined,
      });
      return Object.assign(material, { userData: { ...material.userData, mask } });
    }

    /** @param {string} name @returns {any} */
    get(name) {
      return /** @type {any} */ (this.#options)[name];
    }

    /** Change an option. @param {string} name @param {any} value */
    change(name, value) {
      const given = name === 'text' && typeof value === 'number' ? String(value) : value;
      const wanted = given === undefined ? /** @type {any} */ (DEFAULTS)[name] : given;
      checkOption(name, wanted);
      const options = /** @type {any} */ (this.#options);
      if (Object.is(options[name], wanted)) return;
      options[name] = wanted;
      if (name in LAYOUT || (name.startsWith('color') && this.#layout?.hasInk)) this.#markStale();
      if (name in LAYOUT) return;
      if (name in ARRANGEMENT || name.startsWith('outlineOffset') || (name === 'color' && this.#options.colorRanges)) this.#arrange();
      else if (name === 'ariaLive') this.#mirror.say(this.#options.text, value);
      else this.#paint();
    }

    #markStale() {
      if (this.#isStale) return;
      this.#isStale = true;
      queueMicrotask(() => this.sync().catch(() => {})); // the event and `error` tell
    }

    /**
     * Show the text as its options say. It is done by itself after a change; this tells when.
     *
     * @param {() => void} [callback] called when it is done, or has failed
     * @returns {Promise<void>}
     * @throws {VextureError} if it cannot be set
     */
    sync(callback) {
      this.#syncing ??= this.#syncWhileStale().finally(() => {
        this.#syncing = null;
      });
      if (callback) this.#syncing.then(() => callback(), () => callback());
      return this.#syncing;
    }

    async #syncWhileStale() {
      while (this.#isStale) {
        this.#isStale = false;
        this.dispatchEvent(/** @type {any} */ ({ type: 'syncstart' }));
        try {
          await this.#syncOnce();
        } catch (error) {
          if (this.#isStale) continue; // a later change may mend it
          this.error = /** @type {Error} */ (error);
          this.dispatchEvent(/** @type {any} */ ({ type: 'error', message: this.error.message }));
          reportOnce(this.error.message);
          throw error;
        }
      }
    }

    async #syncOnce() {
      const options = this.#options;
      const { font } = options, atlas = font instanceof AtlasFont ? font : null;
      const layout = options.text ? await this.#typeset(atlas) : null;
      if (atlas !== this.#atlas) this.#takeTexture(atlas);
      this.#layout = layout;
      this.error = null;
      this.#arrange();
      this.#mirror.say(options.text, options.ariaLive);
      if (layout) warnOf(layout);
      this.dispatchEvent(/** @type {any} */ ({ type: 'synccomplete' }));
    }

    /** @param {AtlasFont | null} atlas @returns {Promise<TextLayout> | TextLayout} */
    #typeset(atlas) {
      const { font, fontWeight, fontStyle, colorRanges } = this.#options;
      const request = { ...requestOf(this.#options), inks: inksOf(this.#plainColor, colorRanges) };
      if (atlas) return atlas.typeset(request);
      return this.#glyphs.typeset(request, { font: /** @type {any} */ (font), weight: weightOf(fontWeight), isItalic: fontStyle === 'italic' });
    }

    /** Show shapes of a baked font, or again those of the glyphs. @param {AtlasFont | null} atlas */
    #takeTexture(atlas) {
      this.#atlas = atlas;
      for (const name of [...this.#parts.keys()]) this.#removePart(name);
      this.#material.userData.mask.set({ texture: this.#shapes.texture });
    }

    /** What has the shapes: their texture, and of each the part of its unit square that it fills. */
    get #shapes() {
      return this.#atlas ?? this.#glyphs.texture.asShapes;
    }

    *#shapesInUse() {
      if (this.#atlas) return;
      const { outlines, strokes, ...letters } = this.#layout ?? NOTHING;
      for (const one of [letters, outlines, strokes]) if (one) yield* one.shapes;
    }

    /** @param {ReadonlyMap<number, number>} places */
    #renumber(places) {
      if (!this.#layout || this.#atlas) return;
      const { outlines, strokes } = this.#layout;
      for (const one of [this.#layout, outlines, strokes]) {
        if (!one) continue;
        if (one.shapes.some((shape) => !places.has(shape))) return this.#markStale();
        one.shapes = one.shapes.map((shape) => /** @type {number} */ (places.get(shape)));
      }
      this.#arrange();
    }

    /** Put the glyphs where they are. */
    #arrange() {
      const layout = this.#layout ?? NOTHING;
      const { roots } = this.#shapes.texture;
      const { outlines, strokes } = layout;
      const isMap = (/** @type {number} */ shape) => roots[shape].isMap;
      const hasMaps = layout.shapes.some(isMap);
      this.#fill(/** @type {GlyphGeometry} */ (this.geometry), hasMaps ? chosen(layout, (shape) => !isMap(shape)) : layout, 'letters');
      this.#show('colored', hasMaps ? chosen(layout, isMap) : null);
      this.#show('outline', outlines ?? null);
      this.#show('stroke', strokes ?? null);
      this.#paint();
    }

    /** @param {string} name @param {PlacedShapes | null} placed */
    #show(name, placed) {
      if (!placed) return this.#removePart(name);
      let part = this.#parts.get(name);
      if (!part) {
        part = new Part(this.#masked(name));
        this.#parts.set(name, part);
        this.add(part);
      }
      this.#fill(/** @type {GlyphGeometry} */ (part.geometry), placed, name);
    }

    /** @param {string} name */
    #removePart(name) {
      const part = this.#parts.get(name);
      if (!part) return;
      this.remove(part);
      part.geometry.dispose();
      /** @type {Material} */ (part.material).dispose();
      this.#parts.delete(name);
    }

    /**
     * @param {GlyphGeometry} geometry
     * @param {PlacedShapes & { clusters?: Uint32Array }} placed
     * @param {string} part
     */
    #fill(geometry, placed, part) {
      const { clipRect, colorRanges, curveRadius, curve } = this.#options;
      const { boxes } = this.#shapes;
      const colors = part === 'letters' && colorRanges && placed.clusters ? colorsOf(placed.clusters, colorRanges, this.#plainColor) : null;
      const baseline = this.#layout?.lines[0]?.baseline ?? 0;
      const bend = curve ? alongCurve(curve, baseline) : isBent(curveRadius) ? onCylinder(curveRadius) : null;
      geometry.setGlyphs(placed, { boxOf: (shape) => boxes[shape], clip: clipRect, colors, bend, z: 0 });
    }

    /** Colour of what has no colour of its own. */
    get #plainColor() {
      return this.#options.color ?? /** @type {any} */ (this.#base)?.color ?? 0xffffff;
    }

    /** Set the colours and opacities. */
    #paint() {
      const { fillOpacity, outlineColor, outlineOpacity, outlineOffsetX, outlineOffsetY, strokeColor, strokeOpacity, depthOffset, fontSize, colorRanges } = this.#options;
      paint(this.#material, colorRanges ? 0xffffff : this.#plainColor, fillOpacity * (this.#base?.opacity ?? 1), depthOffset);
      if (this.#material.vertexColors !== Boolean(colorRanges)) {
        this.#material.vertexColors = Boolean(colorRanges);
        this.#material.needsUpdate = true;
      }
      for (const [name, part] of this.#parts) {
        const { material } = part;
        if (name === 'outline') paint(material, outlineColor, outlineOpacity, depthOffset);
        if (name === 'stroke') paint(material, strokeColor, strokeOpacity, depthOffset);
        if (name === 'colored') paint(material, null, fillOpacity, depthOffset);
        if (name === 'outline') part.position.set(lengthOf(outlineOffsetX, fontSize), -lengthOf(outlineOffsetY, fontSize), 0);
      }
    }

    /** What three.js calls before it sorts what it draws: the parts follow the text. @param {boolean} [force] */
    updateMatrixWorld(force) {
      for (const [name, part] of this.#parts ?? []) part.follow(this, name === 'outline');
      super.updateMatrixWorld(force);
    }

    /** @param {any} renderer @param {any} _scene @param {any} camera */
    onBeforeRender(renderer, _scene, camera) {
      beforeDrawing(this, renderer, camera);
    }

    /**
     * Meet a ray. An intersection is anywhere in the block of the text, or in a glyph of one along a curve; its `instanceId` is
     * the glyph there, and `charIndex` its first character, or -1 between glyphs.
     *
     * @param {import('three').Raycaster} raycaster
     * @param {import('three').Intersection[]} hits
     */
    raycast(raycaster, hits) {
      const layout = this.#layout;
      if (!layout) return;
      RAY.copy(raycaster.ray).applyMatrix4(INVERSE.copy(this.matrixWorld).invert());
      for (const { distance, glyph } of meetText(RAY, layout, this.#shapes.boxes, this.#options)) {
        const local = RAY.at(distance, new Vector3()), point = local.clone().applyMatrix4(this.matrixWorld);
        const far = raycaster.ray.origin.distanceTo(point);
        if (far < raycaster.near || far > raycaster.far) continue;
        hits.push(/** @type {any} */ ({ distance: far, point, object: this, local, instanceId: glyph, charIndex: glyph < 0 ? -1 : layout.clusters[glyph] }));
      }
    }

    /** @param {any} source @param {boolean} [recursive] */
    copy(source, recursive) {
      const parts = source.children.filter((/** @type {any} */ { isTextPart }) => isTextPart);
      source.remove(...parts);
      Object3D.prototype.copy.call(this, source, recursive); // that of a mesh would share the material, which has a mask
      if (parts.length) source.add(...parts);
      this.#take(source.glyphs);
      this.#setBase(source.#base);
      for (const name of Object.keys(DEFAULTS)) this.change(name, source.get(name));
      return this;
    }

    /** Free the GPU memory. The texture of glyphs is that of other texts, too. */
    dispose() {
      this.#unfollow();
      this.#mirror.dispose();
      for (const name of [...this.#parts.keys()]) this.#removePart(name);
      this.geometry.dispose();
      this.#material.dispose();
    }
  }

  for (const name of Object.keys(DEFAULTS)) {
    Object.defineProperty(Text.prototype, name, {
      configurable: true,
      get() {
        return this.get(name);
      },
      set(value) {
        this.change(name, value);
      },
    });
  }
  return /** @type {any} */ (Text);
}

/**
 * @param {Uint32Array} clusters
 * @param {Record<number, any>} ranges
 * @param {any} color of what is before them
 * @returns {Float32Array} linear
 */
function colorsOf(clusters, ranges, color) {
  const starts = Object.keys(ranges).map(Number).sort((a, b) => a - b);
  const before = new Color(color ?? 0xffffff), tones = starts.map((start) => new Color(ranges[start]));
  const colors = new Float32Array(3 * clusters.length);
  clusters.forEach((cluster, k) => {
    const place = starts.findLastIndex((start) => start <= cluster);
    (place < 0 ? before : tones[place]).toArray(colors, 3 * k);
  });
  return colors;
}
