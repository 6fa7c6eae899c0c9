/** Scale bar and north arrow. */
import { Vector3 } from 'three';
import { element } from '../viewer/dom.js';
import { FIELD } from './presets.js';

/** Most pixels of the scale bar. */
const LONGEST = 130;

/** The longest of 1, 2, 5, 10, ... metres that is no longer than this. @param {number} metres */
export function roundLength(metres) {
  const power = 10 ** Math.floor(Math.log10(metres));
  return power * ([5, 2].find((times) => times * power <= metres) ?? 1);
}

/** @param {number} metres */
export const lengthText = (metres) => (metres >= 1000 ? `${metres / 1000} km` : `${metres} m`);

/**
 * Metres on the ground across a pixel at what the camera looks at, and how far the north is turned from up, clockwise in
 * degrees.
 *
 * @param {import('./stage.js').Stage} stage
 */
export function bearingsOf({ camera, controls, size, surface }) {
  const ahead = camera.getWorldDirection(new Vector3());
  const up = new Vector3(0, 1, 0).applyQuaternion(camera.quaternion);
  const [x, z] = Math.abs(ahead.y) > 0.99 ? [up.x, up.z] : [ahead.x, ahead.z];
  const north = (Math.atan2(-x, -z) * 180) / Math.PI;
  const half = 'isOrthographicCamera' in camera
    ? (camera.top - camera.bottom) / 2 / camera.zoom
    : Math.tan((FIELD * Math.PI) / 360) * camera.position.distanceTo(controls.target);
  return { metres: (2 * half) / size.height / surface.places.scale, north };
}

/** @param {import('./stage.js').Stage} stage */
export function createBearings(stage) {
  const text = element('span', {});
  const bar = element('div', { class: 'bar' }, text);
  const arrow = element('div', { class: 'north', role: 'img' }, 'N');
  const made = element('div', { class: 'bearings', title: 'Scale at the middle of the picture, and the north' }, arrow, bar);
  let before = '';
  stage.addEventListener('frame', () => {
    const { metres, north } = bearingsOf(stage);
    const length = roundLength(metres * LONGEST);
    const [wide, turn] = [(length / metres).toFixed(1), north.toFixed(1)];
    if (`${wide} ${turn} ${length}` === before) return;
    before = `${wide} ${turn} ${length}`;
    bar.style.width = `${wide}px`;
    text.textContent = lengthText(length);
    arrow.style.rotate = `${turn}deg`;
    arrow.setAttribute('aria-label', `North is ${Math.round((Number(turn) + 360) % 360)} degrees clockwise from up`);
  });
  return made;
}
