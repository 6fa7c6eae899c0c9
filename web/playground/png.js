// Draws an SVG as a PNG of about as many bytes as the texture has.

/** Sides of the PNG that are tried, in pixels. */
const LEAST = 8;
const MOST = 2048;

/** Share of the bytes that may be missing. */
const NEAR = 0.05;

/**
 * @typedef {object} EqualPng
 * @property {HTMLCanvasElement} canvas its pixels
 * @property {number} size pixels of a side
 * @property {number} bytes of the file
 */

/**
 * Draw an SVG at the largest size whose PNG has no more bytes than given.
 *
 * @param {string} text of the SVG, which may not refer to other files
 * @param {number} bytes
 * @returns {Promise<EqualPng>}
 */
export async function drawEqualPng(text, bytes) {
  const picture = await pictureOf(text);
  let [low, high] = [LEAST, MOST];
  let best = await drawPng(picture, low);
  while (high - low > 1 && best.bytes < (1 - NEAR) * bytes) {
    const middle = Math.round(Math.sqrt(low * high));
    const size = middle > low && middle < high ? middle : low + 1;
    const drawn = await drawPng(picture, size);
    if (drawn.bytes > bytes) high = size;
    else [low, best] = [size, drawn];
  }
  return best;
}

/**
 * @param {HTMLImageElement} picture
 * @param {number} size
 * @returns {Promise<EqualPng>}
 */
async function drawPng(picture, size) {
  const canvas = Object.assign(document.createElement('canvas'), { width: size, height: size });
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d', { willReadFrequently: true }));
  context.drawImage(picture, 0, 0, size, size);
  const blob = await new Promise((/** @type {(blob: Blob | null) => void} */ done) => canvas.toBlob(done));
  return { canvas, size, bytes: blob?.size ?? 0 };
}

/**
 * The SVG as a picture: its view box in the middle of a square, as in the unit square of the texture.
 *
 * @param {string} text
 */
async function pictureOf(text) {
  const root = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
  const [width, height] = ['width', 'height'].map((name) => parseFloat(root.getAttribute(name) ?? ''));
  if (!root.hasAttribute('viewBox') && width > 0 && height > 0) root.setAttribute('viewBox', `0 0 ${width} ${height}`);
  root.setAttribute('width', String(MOST));
  root.setAttribute('height', String(MOST));
  root.setAttribute('preserveAspectRatio', 'xMidYMid meet');
  const url = URL.createObjectURL(new Blob([new XMLSerializer().serializeToString(root)], { type: 'image/svg+xml' }));
  try {
    const picture = new Image();
    picture.src = url;
    await picture.decode();
    return picture;
  } finally {
    URL.revokeObjectURL(url);
  }
}
