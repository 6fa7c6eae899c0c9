// What is known of the water at each place of its mesh: its depth, and how open it is to waves.
import { Color, Vector3 } from 'three';
import { depths } from '../../generated/water-shader.js';
import { VextureError, line } from '../errors.js';

/** @typedef {import('three').ColorRepresentation} ColorRepresentation */

/**
 * @typedef {object} Calm The look of calm water.
 * @property {ColorRepresentation} [shoal] colour of calm water where it is shallow, by default `0x6b9fb0`
 * @property {ColorRepresentation} [deep] and where it is deep, by default `0x1a5169`
 * @property {number} [clear] metres of water in which the ground below fades to a third, by default 0.6
 * @property {number} [turn] metres in which the one colour turns into the other, by default 2
 * @property {number} [least] how much of the ground the shallowest water hides, 0..1, so that its edge is
 *   seen; by default 0.4
 *
 * @typedef {object} DepthColors Colours of depths.
 * @property {{from: number, color: ColorRepresentation, opacity?: number}[]} classes in ascending order, at most 8: the
 *   colour of depths from so many metres
 * @property {boolean} [smooth] each colour turns into the next, instead of at a line; by default `false`
 */

/** Macro of programs with fields. */
export const FIELDS = 'VEXTURE_FIELDS';

/** Length of the shader's arrays. */
const MOST_CLASSES = Number(/vexture_most_classes\s*=\s*(\d+)/.exec(depths)?.[1]);

const CALM = Object.freeze({ shoal: 0x6b9fb0, deep: 0x1a5169, clear: 0.6, turn: 2, least: 0.4 });

/** Uniforms of depths.glsl, from values that users give. */
export class WaterFields {
  #colors = /** @type {DepthColors | null} */ (null);
  #calm = /** @type {Calm} */ ({});

  constructor() {
    /** @type {Record<string, { value: any }>} */
    this.uniforms = {
      vextureFields: { value: null },
      vextureShoal: { value: new Color() },
      vextureDeep: { value: new Color() },
      vextureMurk: { value: new Vector3() },
      vextureClasses: { value: 0 },
      vextureClassColors: { value: new Float32Array(4 * MOST_CLASSES) },
      vextureClassFrom: { value: new Float32Array(MOST_CLASSES) },
      vextureClassSmooth: { value: false },
    };
    this.calm = {};
  }

  get calm() {
    return { ...CALM, ...this.#calm };
  }

  set calm(/** @type {Calm} */ given) {
    const { shoal, deep, clear, turn, least } = { ...CALM, ...given };
    const wrong = Object.entries({ clear, turn }).find(([, value]) => !(value > 0 && value < Infinity));
    if (wrong) throw new VextureError(`calm: ${wrong[0]} is ${line(wrong[1])}; it must be above 0`, `calm.${wrong[0]}`);
    if (!(least >= 0 && least <= 1)) {
      throw new VextureError(`calm: least is ${line(least)}; it must be from 0 to 1`, 'calm.least');
    }
    this.#calm = { ...given };
    this.uniforms.vextureShoal.value.set(shoal);
    this.uniforms.vextureDeep.value.set(deep);
    this.uniforms.vextureMurk.value.set(clear, turn, least);
  }

  get colors() {
    return this.#colors;
  }

  set colors(/** @type {DepthColors | null} */ given) {
    const classes = given?.classes ?? [];
    if (given && !(classes.length > 0 && classes.length <= MOST_CLASSES)) {
      throw new VextureError(`depthColors has ${classes.length} classes; give 1 to ${MOST_CLASSES}`, 'depthColors');
    }
    if (classes.some(({ from }, at) => !(from >= 0 && from < Infinity) || (at > 0 && !(from > classes[at - 1].from)))) {
      throw new VextureError('depthColors: the depths that classes begin at must ascend from 0', 'depthColors');
    }
    this.#colors = given;
    const { vextureClasses, vextureClassColors, vextureClassFrom, vextureClassSmooth } = this.uniforms;
    vextureClasses.value = classes.length;
    vextureClassSmooth.value = Boolean(given?.smooth);
    classes.forEach(({ from, color, opacity = 1 }, at) => {
      vextureClassFrom.value[at] = from;
      vextureClassColors.value.set([...new Color(color).toArray(), opacity], 4 * at);
    });
  }
}
