/**
 * What a texture's file holds, once read and checked; plain data, without three.js.
 *
 * @typedef {object} RootPaint
 * @property {[number, number, number]} color sRGB components, 0..1
 * @property {number} opacity 0..1
 *
 * @typedef {object} Root A shape of a texture.
 * @property {string} name names the shape within its texture
 * @property {number} quad index of its root quad's texel: all that a shader needs; 0 in a thesis texture
 * @property {number[]} transform a b c d e f: (x, y) of the unit square is (ax + by + c, dx + ey + f) in the source
 * @property {number} tolerance largest distance from the drawing's outline, in unit-square units
 * @property {string | null} crs coordinate reference system of the source's units
 * @property {RootPaint | null} paint its colour, where it is one layer of a drawing; null for a silhouette
 *
 * @typedef {object} PackedData FORMAT.md, part B.
 * @property {'packed'} encoding
 * @property {string} name
 * @property {number} width texels in a row, a power of two
 * @property {number} height rows
 * @property {Uint32Array} texels four words each, row by row
 * @property {Root[]} roots
 *
 * @typedef {object} ThesisData FORMAT.md, part A.
 * @property {'thesis'} encoding
 * @property {string} name
 * @property {8 | 16} bits of each channel
 * @property {number} quadCount rows of the list of quads
 * @property {number} curveCount rows of the list of curves
 * @property {Uint8Array | Uint16Array} quads RGB, four pixels to a row
 * @property {Uint8Array | Uint16Array} curves RGB, two pixels to a row
 * @property {number} levels levels of quads: a descent takes no more steps
 * @property {string} glsl functions that read it in a shader (generated/thesis-shader.js)
 * @property {Root[]} roots one
 *
 * @typedef {PackedData | ThesisData} TextureData
 */

export {};
