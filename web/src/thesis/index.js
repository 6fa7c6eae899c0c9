/**
 * The encoding of the thesis that vexture began with: a pair of PNG files. No other entry imports it.
 *
 * @module
 */
export { ThesisLoader } from './loader.js';
export { readThesis } from './read.js';
export { ThesisTexture } from './texture.js';

/** @typedef {import('./loader.js').PairUrl} PairUrl */
/** @typedef {import('./read.js').ThesisData} ThesisData */
