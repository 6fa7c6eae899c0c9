import { FOLD_HEIGHT, thesis } from '../../generated/thesis-shader.js';

/**
 * GLSL functions that read a thesis texture, with the constants that depend on its data.
 *
 * @param {import('./read.js').ThesisData} data
 */
export function thesisFunctions({ levels }) {
  return `const int thesis_LEVELS = ${levels};\nconst int thesis_FOLD_HEIGHT = ${FOLD_HEIGHT};\n${thesis}`;
}
