// Outlines of strokes, by the kernel `stroke_path`.

/** @import { Kernels } from './kernels.js' */
/** @import { StrokeStyle } from './strokes.js' */

/**
 * Make the contours of a stroke, to fill by the nonzero rule.
 *
 * @param {Kernels} kernels
 * @param {Float64Array} cubics of one subpath
 * @param {boolean} closed
 * @param {StrokeStyle} style
 * @returns {Float64Array[]}
 */
export function outlineStroke(kernels, cubics, closed, { width, cap, join, miterLimit, tolerance, dashes, dashOffset }) {
  const caps = ['butt', 'round', 'square'], joins = ['miter', 'round', 'bevel', 'miter-clip', 'arcs'];
  const style = [width, caps.indexOf(cap), joins.indexOf(join), miterLimit, tolerance, dashOffset];
  const { contours, lengths } = kernels.call('stroke_path', [cubics, [cubics.length / 8], [closed], style, dashes]);
  let at = 0;
  return Array.from(lengths, (length) => contours.slice(at, (at += 8 * Number(length))));
}
