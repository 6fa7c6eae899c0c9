/** Buttons for what one takes from the page: a link, a picture, a video. */
import { element } from '../viewer/dom.js';
import { download, picture, record } from './capture.js';

/** Sizes of pictures, by name: pixels, or null for that of the window. */
const SIZES = Object.freeze(/** @type {const} */ ([
  ['Window', null], ['1920 × 1080', [1920, 1080]], ['3840 × 2160', [3840, 2160]], ['1080 × 1080', [1080, 1080]],
]));

/** Milliseconds that the last step is shown in a video. */
const LAST = 1500;

/**
 * @param {import('./stage.js').Stage} stage
 * @param {import('./player.js').Player} player
 * @param {{caption: () => import('./capture.js').Caption, link: () => string, say: (message: string) => void,
 *   name: string}} what
 */
export function createTakeaway(stage, player, { caption, link, say, name }) {
  const decorated = element('input', { type: 'checkbox', id: 'decorated', checked: true });
  const size = element('select', { 'aria-label': 'Size of pictures', title: 'Size of pictures' },
    ...SIZES.map(([text], at) => element('option', { value: at }, text)));
  const captioned = () => (decorated.checked ? caption() : null);
  const button = (/** @type {string} */ text, /** @type {() => Promise<void>} */ act) => element('button', {
    type: 'button',
    onclick: () => act().catch((error) => say(error.message)),
  }, text);

  async function copy() {
    if (location.protocol === 'about:') {
      throw new Error('A page in a notebook has no address of its own; save it as a file, which has.');
    }
    const address = link();
    history.replaceState(null, '', address);
    try {
      await navigator.clipboard.writeText(location.href);
      say('The link is copied: it opens this view at this time.');
    } catch {
      say('The link is in the address bar: it opens this view at this time.');
    }
  }

  async function take() {
    const { canvas } = stage;
    const wanted = SIZES[Number(size.value)][1] ?? /** @type {[number, number]} */ ([canvas.width, canvas.height]);
    download(await picture(stage, captioned(), [wanted[0], wanted[1]]), `${name}.png`);
  }

  async function film() {
    if (!('MediaRecorder' in window)) throw new Error('This browser records no videos; try another one.');
    video.disabled = true;
    try {
      await player.go(0);
      const end = record(stage, captioned);
      player.play();
      await new Promise((done) => player.addEventListener('play', done, { once: true }));
      await new Promise((done) => setTimeout(done, LAST));
      const film = await end();
      download(film, `${name}.${film.type.includes('mp4') ? 'mp4' : 'webm'}`);
    } finally {
      video.disabled = false;
    }
  }

  const video = button('Video', film);
  video.hidden = player.count < 2;
  player.addEventListener('steps', () => (video.hidden = player.count < 2));
  return element('div', { class: 'takeaway' },
    element('div', { class: 'row' }, button('Link', copy), button('Picture', take), video, size),
    element('label', { class: 'row', for: 'decorated' }, decorated, 'with title, legend and source'));
}
