/**
 * Contents of a texture's file after reading and validation: plain data, without three.js.
 *
 * @typedef {object} RootPaint A colour of a shape.
 * @property {[number, number, number]} color sRGB components, 0..1
 * @property {number} opacity 0..1
 *
 * @typedef {object} Root A shape of a texture.
 * @property {string} name unique within the texture
 * @property {number} quad index of its root quad's texel, the start of a shader's descent; 0 in a thesis texture
 * @property {number[]} transform a b c d e f: (x, y) of the unit square is (ax + by + c, dx + ey + f) in the source
 * @property {number} tolerance largest distance from the drawing's outline, in unit-square units
 * @property {string | null} crs coordinate reference system of the source's units
 * @property {RootPaint | null} paint its colour, if it is a layer of a drawing; null for a silhouette or a map
 * @property {boolean} isMap whether it is a planar map: a whole drawing in its colours
 * @property {boolean} hasGradients whether a paint of the map is a program: it holds gradients or pictures
 * @property {boolean} hasPictures whether one holds pictures
 * @property {import('./style.js').Style | null} style elements of a map that can be recoloured; otherwise null
 *
 * @typedef {object} TextureData Common to all encodings.
 * @property {string} encoding name of the encoding
 * @property {string} name of the texture, from its file
 * @property {Root[]} roots the shapes, the layers of a drawing in painting order
 *
 * @typedef {object} PackedData FORMAT.md, parts B and D.
 * @property {'packed'} encoding name of the encoding
 * @property {string} name of the texture, from its file
 * @property {number} width texels in a row, a power of two
 * @property {number} height rows
 * @property {Uint32Array} texels four words each, row by row
 * @property {Root[]} roots the shapes, the layers of a drawing in painting order
 */

export {};
