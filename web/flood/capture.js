/** Pictures and videos of the page, with its title, time, legend, scale, north and credits, or without. */
import { bearingsOf, lengthText, roundLength } from './bearings.js';
import { entries } from './legend.js';

/**
 * @typedef {object} Caption
 * @property {string} title
 * @property {string} when
 * @property {string} credits
 * @property {ReturnType<typeof import('./shades.js').shadeOf>} shade
 */

const INK = '#1a1c20';
const PAPER = 'rgb(250 249 246 / 88%)';
/** Pixels between a border and what is near it, at a height of 720 pixels. */
const MARGIN = 16;
const FRAMES = 30;

/**
 * Draw the stage's picture and what is written on it.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {import('./stage.js').Stage} stage just rendered
 * @param {Caption | null} caption
 */
export function compose(context, stage, caption) {
  const { width, height } = context.canvas;
  context.drawImage(stage.canvas, 0, 0, width, height);
  if (!caption) return;
  const unit = Math.max(height / 720, 0.75);
  const [edge, font] = [MARGIN * unit, (/** @type {number} */ size, weight = 400) => `${weight} ${size * unit}px system-ui, sans-serif`];
  const panel = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ wide, /** @type {number} */ high) => {
    context.fillStyle = PAPER;
    context.fillRect(x, y, wide, high);
    context.fillStyle = INK;
  };
  context.textBaseline = 'top';
  context.font = font(20, 600);
  const heading = [caption.title, caption.when].filter(Boolean).join(' · ');
  panel(edge, edge, Math.min(context.measureText(heading).width + 20 * unit, width - 2 * edge), 34 * unit);
  context.fillText(heading, edge + 10 * unit, edge + 7 * unit, width - 2 * edge - 20 * unit);
  context.font = font(12);
  const wide = Math.min(context.measureText(caption.credits).width + 16 * unit, width - 2 * edge);
  if (caption.credits) {
    panel(edge, height - edge - 22 * unit, wide, 22 * unit);
    context.fillText(caption.credits, edge + 8 * unit, height - edge - 17 * unit, wide - 16 * unit);
  }
  bearings(context, stage, unit, panel, edge);
  if (caption.shade) legend(context, caption.shade, unit, panel, edge);
}

/**
 * @param {CanvasRenderingContext2D} context @param {import('./stage.js').Stage} stage @param {number} unit
 * @param {(x: number, y: number, wide: number, high: number) => void} panel @param {number} edge
 */
function bearings(context, stage, unit, panel, edge) {
  const { width, height } = context.canvas;
  const { metres, north } = bearingsOf(stage);
  const each = (metres * stage.size.height) / height;
  const length = roundLength(each * 140 * unit);
  const long = length / each;
  const [x, y] = [width - edge - long - 50 * unit, height - edge - 60 * unit];
  panel(x, y, long + 50 * unit, 36 * unit);
  context.strokeStyle = INK;
  context.lineWidth = 2 * unit;
  context.beginPath();
  context.moveTo(x + 40 * unit, y + 14 * unit);
  context.lineTo(x + 40 * unit, y + 28 * unit);
  context.lineTo(x + 40 * unit + long, y + 28 * unit);
  context.lineTo(x + 40 * unit + long, y + 14 * unit);
  context.stroke();
  context.fillText(lengthText(length), x + 46 * unit, y + 10 * unit);
  context.save();
  context.translate(x + 20 * unit, y + 18 * unit);
  context.rotate((north * Math.PI) / 180);
  context.beginPath();
  for (const [dx, dy] of [[0, -14], [6, 0], [-6, 0]]) context.lineTo(dx * unit, dy * unit);
  context.fill();
  context.textAlign = 'center';
  context.fillText('N', 0, unit);
  context.restore();
}

/**
 * @param {CanvasRenderingContext2D} context @param {NonNullable<Caption['shade']>} shade @param {number} unit
 * @param {(x: number, y: number, wide: number, high: number) => void} panel @param {number} edge
 */
function legend(context, shade, unit, panel, edge) {
  const rows = entries(shade);
  const wide = Math.max(...[shade.title, ...rows.map(({ text }) => text)].map((text) => context.measureText(text).width));
  const [x, y] = [context.canvas.width - edge - wide - 52 * unit, edge];
  panel(x, y, wide + 52 * unit, (28 + 18 * rows.length) * unit);
  context.fillText(shade.title, x + 10 * unit, y + 7 * unit);
  rows.forEach(({ color, text }, at) => {
    const top = y + (26 + 18 * at) * unit;
    context.fillStyle = color;
    context.fillRect(x + 10 * unit, top, 22 * unit, 13 * unit);
    context.fillStyle = INK;
    context.fillText(text, x + 40 * unit, top);
  });
}

/** @param {Blob} blob @param {string} name */
export function download(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/**
 * A picture of what is shown.
 *
 * @param {import('./stage.js').Stage} stage
 * @param {Caption | null} caption
 * @param {[number, number]} size in pixels
 * @returns {Promise<Blob>}
 */
export function picture(stage, caption, size) {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = size;
  stage.renderedAt(size, () => {
    compose(/** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d')), stage, caption);
  });
  return new Promise((resolve, reject) => {
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('The browser could not write the picture.'))));
  });
}

/**
 * The stage at a time of its waves, as a PNG in a data: URL.
 *
 * @param {import('./stage.js').Stage} stage @param {Caption | null} caption @param {number} seconds
 */
export function still(stage, caption, seconds) {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [stage.canvas.width, stage.canvas.height];
  stage.freeze(seconds);
  compose(/** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d')), stage, caption);
  return canvas.toDataURL();
}

/**
 * Records what the stage shows until it is stopped.
 *
 * @param {import('./stage.js').Stage} stage
 * @param {() => Caption | null} caption
 * @returns {() => Promise<Blob>} ends the recording
 */
export function record(stage, caption) {
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [stage.canvas.width & ~1, stage.canvas.height & ~1]; // codecs want even sides
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  const drawn = () => compose(context, stage, caption());
  stage.addEventListener('frame', drawn);
  const stream = canvas.captureStream(FRAMES);
  const recorder = new MediaRecorder(stream, { videoBitsPerSecond: 12_000_000 });
  /** @type {Blob[]} */
  const parts = [];
  recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
  recorder.start();
  return () => new Promise((resolve) => {
    recorder.addEventListener('stop', () => {
      stage.removeEventListener('frame', drawn);
      for (const track of stream.getTracks()) track.stop();
      resolve(new Blob(parts, { type: recorder.mimeType }));
    });
    recorder.stop();
  });
}
