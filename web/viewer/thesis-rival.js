/** The same drawing in the thesis's encoding, for comparison. */
import { ThesisTexture, readThesis } from '../src/thesis/index.js';
import { thesisFunctions } from '../src/thesis/shader.js';
import { Pass } from './pass.js';
import { HEAD, uniforms } from './rivals.js';
import { RIVAL_NAMES } from './state.js';

const MAIN = `
uniform sampler2D quads;
uniform sampler2D curves;
void main() {
  vec2 center = start + gl_FragCoord.xy * side;
  float cover = thesis_coverage(quads, curves, center, vec2(side, 0.0), vec2(0.0, side));
  pixel = mix(backdrop(), vec4(tint, 1.0), cover);
}
`;

/**
 * @param {ArrayBuffer[]} pair contents of both files
 * @param {string} name
 * @param {import('./drawing.js').ShownDrawing} drawing compared with; the thesis's encoding has no colours
 * @param {import('./backdrop.js').Backdrop} backdrop
 * @returns {Promise<import('./rivals.js').Rival>}
 */
export async function thesisRival([quads, curves], name, drawing, backdrop) {
  const texture = new ThesisTexture(await readThesis(quads, curves, name));
  const { data, textures } = texture;
  const pass = new Pass(thesisFunctions(data) + HEAD + MAIN, uniforms(backdrop, drawing, {
    quads: { value: textures.quads }, curves: { value: textures.curves },
    thesis_list_lengths: { value: [data.quadCount, data.curveCount] },
  }));
  const method = RIVAL_NAMES[data.bits === 16 ? 'thesis16' : 'thesis8'];
  const isSilhouette = drawing.count > 1 || drawing.maps !== 'none';
  return {
    pass, label: `${method}${isSilhouette ? ': silhouette' : ''}`, dispose: () => {
      pass.dispose();
      texture.dispose();
    },
  };
}
