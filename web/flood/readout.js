/** Readout at the pointer: wet or dry, depth, coordinates. */
import { Raycaster, Vector2 } from 'three';
import { element } from '../viewer/dom.js';
import { WATER } from './sea.js';
import { depthsOf } from './steps.js';

/** @typedef {import('./stage.js').Stage} Stage @typedef {import('./player.js').Player} Player */

const NOTHING = 'Point at the ground or the water.';

/**
 * @param {Stage} stage
 * @param {Player} player
 * @param {import('./relief.js').Surface} surface
 * @param {{at: (u: number, v: number, seconds: number) => {u: number, v: number}} | null} fold
 */
export function createReadout(stage, player, surface, fold) {
  const { places } = surface;
  const state = element('strong', {});
  const where = element('span', { class: 'where' });
  const region = element('section', { class: 'readout', role: 'region', 'aria-label': 'Pointer' }, state, where);
  const caster = new Raycaster();
  /** @type {[number, number] | null} */
  let pointed = null;
  /** @type {{key: string, depths: Awaited<ReturnType<typeof depthsOf>>}} */
  let known = { key: '', depths: null };

  async function loadDepths() {
    const { step } = player;
    const key = step ? `${step.name} ${step.manifest.views?.depth ?? step.manifest.views?.ranks}` : '';
    if (key === known.key) return;
    known = { key, depths: null };
    if (!step) return;
    try {
      const depths = await depthsOf(step);
      if (known.key === key) known = { key, depths };
    } catch {
      return; // wet or dry does not depend on it
    }
    show();
  }

  function show() {
    const place = pointed && placeAt(pointed[0], pointed[1]);
    if (!place || !player.step) {
      state.textContent = '';
      where.textContent = NOTHING;
      return;
    }
    const [s, t] = place;
    const [u, v] = places.toUnit(s, t);
    const moved = fold ? fold.at(u, v, stage.seconds) : { u, v };
    const ground = surface.relief.at(s, t);
    const level = surface.levels ? surface.levelNear(s, t) : 0;
    const isWet = player.step.texture.contains(moved.u, moved.v, WATER);
    const depth = isWet ? known.depths?.textAt(s, t) : null;
    state.textContent = isWet ? (depth ? `Wet, ${depth} deep` : 'Wet') : 'Dry';
    const hasLevel = depth && !player.step.manifest.facts?.ranges; // that of a class is only drawn
    const still = surface.relief.still;
    const heights = surface.relief.invented ? [] : [
      `ground ${signed(ground + still)}`, ...(hasLevel ? [`water ${signed(level + still)}`] : []),
    ];
    const texts = [heights.join(', '), `${places.text(u, v)} · ${places.crs}`, places.geodetic(s, t)];
    where.replaceChildren(...texts.filter((text) => text).map((text) => element('span', {}, /** @type {string} */ (text))));
  }

  /** @param {number} px @param {number} py CSS pixels of the canvas */
  function placeAt(px, py) {
    const { width, height } = stage.size;
    caster.setFromCamera(new Vector2((px / width) * 2 - 1, 1 - (py / height) * 2), stage.camera);
    return surface.meets(caster.ray.origin, caster.ray.direction);
  }

  const point = (/** @type {PointerEvent} */ event) => {
    const box = stage.canvas.getBoundingClientRect();
    pointed = [event.clientX - box.left, event.clientY - box.top];
    show();
  };
  stage.canvas.addEventListener('pointerdown', point);
  stage.canvas.addEventListener('pointermove', point);
  stage.canvas.addEventListener('pointerleave', (event) => {
    if (event.pointerType !== 'mouse') return; // a touched point stays
    pointed = null;
    show();
  });
  player.addEventListener('step', () => {
    void loadDepths();
    show();
  });
  stage.addEventListener('frame', () => {
    if (pointed) show(); // the waves or the camera may have moved
  });
  show();
  return { region, placeAt };
}

/** Metres above the zero of the heights. @param {number} height */
const signed = (height) => `${height < 0 ? '−' : '+'}${Math.abs(height).toFixed(2)} m`;
