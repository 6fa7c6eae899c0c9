/** A pin at the marked place, over the picture. */
import { Vector3 } from 'three';
import { element } from '../viewer/dom.js';

/** @param {import('./stage.js').Stage} stage */
export function createPin(stage) {
  const { surface } = stage;
  const pin = element('div', { class: 'pin', hidden: true, role: 'img', 'aria-label': 'The marked place' });
  /** @type {[number, number] | null} of the box */
  let place = null;
  const put = () => {
    if (!place) return;
    const [x, z] = surface.places.toWorld(...place);
    const at = new Vector3(x, surface.height(x, z), z).project(stage.camera);
    pin.hidden = Math.abs(at.z) > 1; // behind the camera
    const [across, down] = [((at.x + 1) / 2) * stage.size.width, ((1 - at.y) / 2) * stage.size.height];
    pin.style.translate = `${across.toFixed(1)}px ${down.toFixed(1)}px`;
  };
  stage.addEventListener('frame', put);
  return {
    element: pin,
    /** @param {[number, number] | null} marked */
    mark: (marked) => {
      place = marked;
      pin.hidden = place === null;
      put();
    },
  };
}
