/** The picture and the address of the view, copied to the clipboard or saved. */

/** What systems do not take in the name of a file. */
const NOT_IN_NAMES = /[\\/:*?"<>|\u0000-\u001f]+/g;

/** @param {string} text */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false; // no permission, or an insecure context
  }
}

/**
 * The canvas with its overlays.
 *
 * @param {import('./engine.js').Engine} engine
 * @param {HTMLImageElement | null} image right of the divider
 * @returns {Promise<Blob>}
 */
export async function pictureOf(engine, image) {
  const { canvas, state, ratio } = engine;
  const sheet = document.createElement('canvas');
  sheet.width = canvas.width;
  sheet.height = canvas.height;
  const context = /** @type {CanvasRenderingContext2D} */ (sheet.getContext('2d'));
  engine.render();
  context.drawImage(canvas, 0, 0); // in the same task as the frame: later the canvas may be empty
  if (image) {
    const from = state.value.split * canvas.width;
    context.save();
    context.beginPath();
    context.rect(from, 0, canvas.width - from, canvas.height);
    context.clip();
    context.filter = getComputedStyle(image).filter;
    context.drawImage(image, 0, 0, image.width * ratio, image.height * ratio);
    context.restore();
  }
  return new Promise((resolve, reject) => {
    sheet.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('the picture is too large for this browser'))));
  });
}

/**
 * Save a file where the browser saves files.
 *
 * @param {Blob} content
 * @param {string} name of what it shows
 * @param {string} suffix
 */
export function saveFile(content, name, suffix) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = `${name.replace(NOT_IN_NAMES, '-') || 'vexture'}.${suffix}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/**
 * @param {Blob} picture PNG
 * @param {string} name
 * @returns {Promise<'copied' | 'saved'>}
 */
export async function copyPicture(picture, name) {
  try {
    await navigator.clipboard.write([new ClipboardItem({ 'image/png': picture })]);
    return 'copied';
  } catch {
    saveFile(picture, name, 'png');
    return 'saved';
  }
}
