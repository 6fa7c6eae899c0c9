/** Files given to the page: dropped anywhere, or chosen. */
import { element } from './dom.js';

const TYPES = '.svg,.svgz,.geojson,.json,.ktx2,.png,.jpg,.jpeg,.webp,.gif,.bmp';

/**
 * Listen for files on the whole page.
 *
 * @param {(files: File[]) => void} given
 */
export function acceptDrops(given) {
  const root = document.documentElement;
  let depth = 0;
  const mark = (/** @type {number} */ next) => {
    depth = Math.max(0, next);
    root.classList.toggle('dropping', depth > 0);
  };
  addEventListener('dragenter', () => mark(depth + 1));
  addEventListener('dragleave', () => mark(depth - 1));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    mark(0);
    given([...(event.dataTransfer?.files ?? [])]);
  });
}

/**
 * A button that opens the system's choice of files.
 *
 * @param {(files: File[]) => void} given
 */
export function fileButton(given) {
  const input = element('input', { type: 'file', accept: TYPES, hidden: true, 'aria-label': 'File to open' });
  input.addEventListener('change', () => {
    given([...(input.files ?? [])]);
    input.value = '';
  });
  return element('span', {}, element('button', { type: 'button', onclick: () => input.click() }, 'Open file'), input);
}
