/** Anisotropic filtering of textures. */

/** Names of software renderers. */
const SOFTWARE = /llvmpipe|softpipe|swiftshader|software|basic render/i;

/**
 * Anisotropy of textures: the device's maximum. A software renderer gets 1, since its filter visits the whole bounding
 * box of a footprint, which can take seconds for one pixel on the horizon.
 *
 * @param {import('three').WebGLRenderer} renderer
 */
export function mostSamples(renderer) {
  const gl = renderer.getContext();
  const named = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(named ? named.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  return SOFTWARE.test(name) ? 1 : renderer.capabilities.getMaxAnisotropy();
}

/**
 * Set it for all textures of a scene.
 *
 * @param {import('three').Object3D} scene
 * @param {number} samples
 */
export function sharpen(scene, samples) {
  scene.traverse((object) => {
    const { material } = /** @type {import('three').Mesh<any, import('three').MeshBasicMaterial>} */ (object);
    if (material?.map) material.map.anisotropy = samples;
  });
}
