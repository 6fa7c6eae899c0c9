// The package's entry `vexture/thesis`: the thesis's encoding. No other entry imports it.
export { ThesisLoader } from './loader.js';
export { readThesis } from './read.js';
export { ThesisTexture } from './texture.js';

/** @typedef {import('./read.js').ThesisData} ThesisData */
