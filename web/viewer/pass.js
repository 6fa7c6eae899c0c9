/** One picture that covers the canvas: a triangle, a fragment shader, and whether its program is compiled. */
import { BufferAttribute, BufferGeometry, GLSL3, Mesh, OrthographicCamera, RawShaderMaterial, Scene, Sphere } from 'three';

const VERTEX = 'in vec2 position;\nvoid main() { gl_Position = vec4(position, 0.0, 1.0); }\n';

const PRECISION = 'precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n'
  + 'precision highp usampler2D;\n';

const COVERING = new BufferGeometry();
COVERING.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 3, -1, -1, 3]), 2));
COVERING.boundingSphere = new Sphere(); // for the renderer's sorting of one object

const CAMERA = new OrthographicCamera();

/** @typedef {import('three').WebGLRenderer} WebGLRenderer */

export class Pass {
  /**
   * @param {string} fragment
   * @param {Record<string, {value: any}>} uniforms shared with whoever sets them
   * @param {Record<string, unknown>} [defines]
   */
  constructor(fragment, uniforms, defines = {}) {
    this.uniforms = uniforms;
    this.material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: PRECISION + VERTEX, fragmentShader: PRECISION + fragment, defines,
      depthTest: false, depthWrite: false,
    });
    this.material.uniforms = uniforms;
    const mesh = new Mesh(COVERING, this.material);
    mesh.frustumCulled = false;
    this.scene = new Scene();
    this.scene.add(mesh);
    /** Whether it can be drawn without waiting for the compiler. */
    this.ready = false;
    /** @type {Promise<void> | null} */
    this.compiling = null;
  }

  /**
   * Compile, in the driver's own threads where it has some. Its textures must be set.
   *
   * @param {WebGLRenderer} renderer
   * @returns {Promise<void>}
   */
  compile(renderer) {
    this.compiling ??= renderer.compileAsync(this.scene, CAMERA).then(() => {
      this.ready = true;
    });
    return this.compiling;
  }

  /** @param {WebGLRenderer} renderer */
  draw(renderer) {
    renderer.render(this.scene, CAMERA);
  }

  dispose() {
    this.material.dispose();
  }
}
