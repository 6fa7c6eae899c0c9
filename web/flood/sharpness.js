/** How sharply pictures are seen along the ground. */

/** Renderers on the processor, by the names that drivers give. */
const SOFTWARE = /llvmpipe|softpipe|swiftshader|software|basic render/i;

/**
 * Samples along a footprint that textures take: as many as the device offers. A renderer on the processor takes one:
 * its filter walks through the whole box of a footprint, which for one pixel on the horizon can take seconds.
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
 * Have all pictures of a scene seen so.
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
