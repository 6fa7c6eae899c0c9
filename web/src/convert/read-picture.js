// Pictures as drawings: a rectangle with their pixels, as Python's `picture_drawing` makes it.
import { VextureError } from '../errors.js';
import { loopOf, rectangle } from './contours.js';
import { decodePicture } from './decode-picture.js';
import { fromSource } from './drawing.js';
import { paintOfPicture } from './paints.js';

const LINEAR = 1;

/**
 * Read a picture.
 *
 * @param {Uint8Array} bytes of its file
 * @param {string} [name]
 * @returns {Promise<import('./drawing.js').Drawing>}
 * @throws {VextureError} if it is too large or damaged, or nothing here decodes pictures
 */
export async function readPicture(bytes, name = 'drawing') {
  const pixels = await decodePicture(bytes, name).catch((error) => {
    throw error instanceof VextureError ? error.in(name) : error;
  });
  const { columns, rows } = pixels;
  const paint = paintOfPicture({ toPixels: [[1, 0, 0], [0, 1, 0]], pixels, sampling: LINEAR, opacity: 1 });
  const path = { contours: [loopOf(rectangle(0, 0, columns, rows))], fillRule: 0, paint, group: -1, element: '' };
  return fromSource([path], [0, 0, columns, rows], name);
}
