/** What a page shows, in its address: the step, the camera, the colours. */

/**
 * @typedef {object} Look
 * @property {number} [step]
 * @property {string} [view] name of a view; instead of it:
 * @property {number[]} [camera] position and target of the camera in the world, six numbers
 * @property {number[]} [plan] or, straight from above: what is in the middle, x and z, and how much larger it is
 * @property {string} [colours]
 */

const DIGITS = 3;

/** @param {Look} look */
export function hashOf({ step, view, camera, plan, colours }) {
  const parts = new URLSearchParams();
  if (step) parts.set('step', String(step + 1));
  if (view) parts.set('view', view);
  else if (plan) parts.set('plan', plan.map((number) => number.toFixed(DIGITS)).join(','));
  else if (camera) parts.set('camera', camera.map((number) => number.toFixed(DIGITS)).join(','));
  if (colours && colours !== 'water') parts.set('colours', colours);
  return parts.size ? `#${parts}` : '';
}

/** What an address asks for; what makes no sense is left out. @param {string} hash @returns {Look} */
export function lookOf(hash) {
  const parts = new URLSearchParams(hash.replace(/^#/, ''));
  const step = Number(parts.get('step')) - 1;
  const numbers = (/** @type {string} */ name, /** @type {number} */ count) => {
    const found = (parts.get(name) ?? '').split(',').map((text) => (text.trim() === '' ? NaN : Number(text)));
    return found.length === count && found.every((number) => Math.abs(number) < 1e4) ? found : null;
  };
  const [camera, plan] = [numbers('camera', 6), numbers('plan', 3)];
  return {
    ...(Number.isInteger(step) && step > 0 ? { step } : {}),
    ...(parts.get('view') ? { view: String(parts.get('view')) } : {}),
    ...(camera ? { camera } : {}),
    ...(plan && plan[2] > 0 ? { plan } : {}),
    ...(parts.get('colours') ? { colours: String(parts.get('colours')) } : {}),
  };
}
