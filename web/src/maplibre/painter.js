// Draws tiles directly with WebGL 2: programs, meshes, and textures of texels.
import { VextureError, line } from '../errors.js';
import { gradientsAmong } from '../select-root.js';
import { lookup, paintOf, tileShader } from '../tiles/tile-shader.js';
import { EXTENT, meshOf, quadMesh } from './quad-mesh.js';

/**
 * @typedef {import('../tiles/client.js').LoadedTile} LoadedTile
 * @typedef {import('maplibre-gl').CustomRenderMethodInput} Render
 *
 * @typedef {object} Program
 * @property {WebGLProgram} program
 * @property {(name: string) => WebGLUniformLocation | null} at
 */

/**
 * Units of a tile by which it reaches over its neighbours of other zooms, a part of a pixel: where their sides have different
 * vertices, single pixels would belong to none. What shines through would be seen twice there, so that it has none.
 */
const OVERLAP = 0.25;

/** MapLibre's projection moves the vertices; the offset in the tile's square goes with them. A pole's cap shows what is at the grid's end. */
const vertexShader = (/** @type {Render['shaderData']} */ { vertexShaderPrelude, define }) => `#version 300 es
${vertexShaderPrelude}
${define}
layout(location = 0) in vec2 tilePosition;
uniform vec2 tileRest;
uniform float tileScale;
uniform float tileOverlap;
out vec2 tileOffset;
void main() {
    vec2 place = tilePosition + tileOverlap * (step(vec2(${EXTENT}.0), tilePosition) - step(tilePosition, vec2(0.0)));
    tileOffset = tileRest + tileScale * vec2(place.x, -clamp(place.y, -tileOverlap, ${EXTENT}.0 + tileOverlap));
    gl_Position = projectTile(place, place);
}`;

export class TilePainter {
  #gl;
  /** @type {Map<string, Program>} */
  #programs = new Map();
  /** @type {Map<string, { array: WebGLVertexArrayObject, count: number, buffers: WebGLBuffer[] }>} */
  #meshes = new Map();
  /** @type {Map<LoadedTile, WebGLTexture>} */
  #textures = new Map();

  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.#gl = gl;
    /** Rows of texels that have been sent so far. */
    this.sent = 0;
  }

  /** How many tiles the GPU holds. */
  get held() {
    return this.#textures.size;
  }

  /** Whether its context is lost, and with it all that it has made. */
  get isLost() {
    return this.#gl.isContextLost();
  }

  /**
   * Draw the tiles of a view.
   *
   * @param {{ quad: import('../tiles/choose.js').Quad, loaded: LoadedTile }[]} shown
   * @param {Render} render
   * @param {number} margin
   * @param {number} opacity
   */
  draw(shown, render, margin, opacity) {
    const gl = this.#gl;
    const isMixed = shown.some(({ quad }) => quad.z !== shown[0].quad.z);
    for (const { quad, loaded } of shown) {
      const data = /** @type {import('../data.js').PackedData} */ (loaded.data);
      const { program, at } = this.#program(render.shaderData, gradientsAmong(data.roots));
      gl.useProgram(program);
      setProjection(gl, at, render, quad);
      gl.activeTexture(gl.TEXTURE0);
      gl.bindTexture(gl.TEXTURE_2D, this.#texture(loaded));
      gl.uniform1i(at('vextureTexels'), 0);
      const { base, rest, side, ends } = lookup(quad, loaded.tile, margin);
      gl.uniform2ui(at('tileBase'), ...base);
      gl.uniform2f(at('tileRest'), ...rest);
      gl.uniform2f(at('tileEnds'), ...ends);
      gl.uniform1f(at('tileScale'), side / EXTENT);
      gl.uniform1f(at('tileOpacity'), opacity);
      gl.uniform1f(at('tileOverlap'), isMixed && opacity === 1 ? OVERLAP : 0);
      const { array, count } = this.#mesh(quad);
      gl.bindVertexArray(array);
      for (const root of data.roots) {
        gl.uniform1ui(at('tileRoot'), root.quad);
        gl.uniform4fv(at('tilePaint'), paintOf(root));
        gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_SHORT, 0);
      }
    }
    gl.bindVertexArray(null);
  }

  /**
   * Send rows of texels that have changed.
   *
   * @param {LoadedTile} loaded
   * @param {[number, number][]} runs
   */
  send(loaded, runs) {
    const texture = this.#textures.get(loaded);
    if (!texture || !loaded.data) return; // all of it is sent when it is drawn first
    const gl = this.#gl;
    const { width, height, texels } = loaded.data;
    gl.bindTexture(gl.TEXTURE_2D, texture);
    plainPixels(gl);
    for (const [first, end] of runs) {
      const rows = Math.min(end, height) - first;
      const words = texels.subarray(4 * width * first, 4 * width * (first + rows));
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, first, width, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, words);
      this.sent += rows;
    }
  }

  /** @param {LoadedTile} loaded */
  drop(loaded) {
    const texture = this.#textures.get(loaded);
    if (texture) this.#gl.deleteTexture(texture);
    this.#textures.delete(loaded);
  }

  /** Free everything on the GPU. */
  dispose() {
    const gl = this.#gl;
    for (const { program } of this.#programs.values()) gl.deleteProgram(program);
    for (const { array, buffers } of this.#meshes.values()) {
      gl.deleteVertexArray(array);
      for (const buffer of buffers) gl.deleteBuffer(buffer);
    }
    for (const loaded of [...this.#textures.keys()]) this.drop(loaded);
    this.#programs.clear();
    this.#meshes.clear();
  }

  /**
   * @param {Render['shaderData']} shaderData
   * @param {0 | 1 | 2} gradients
   */
  #program(shaderData, gradients) {
    const key = `${shaderData.variantName} ${gradients}`;
    const known = this.#programs.get(key) ?? linked(this.#gl, vertexShader(shaderData), `#version 300 es\n${tileShader(gradients)}`);
    this.#programs.set(key, known);
    return known;
  }

  /** @param {import('../tiles/grid.js').TileId} quad */
  #mesh(quad) {
    const gl = this.#gl;
    const { key, ...shape } = meshOf(quad);
    const known = this.#meshes.get(key);
    if (known) return known;
    const { positions, indices } = quadMesh(shape);
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const buffers = [positions, indices].map((content, k) => {
      const buffer = gl.createBuffer();
      const target = k ? gl.ELEMENT_ARRAY_BUFFER : gl.ARRAY_BUFFER;
      gl.bindBuffer(target, buffer);
      gl.bufferData(target, content, gl.STATIC_DRAW);
      return buffer;
    });
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.SHORT, false, 0, 0);
    const mesh = { array, count: indices.length, buffers };
    this.#meshes.set(key, mesh);
    return mesh;
  }

  /** @param {LoadedTile} loaded */
  #texture(loaded) {
    const known = this.#textures.get(loaded);
    if (known) return known;
    const gl = this.#gl;
    const { width, height, texels } = /** @type {import('../data.js').PackedData} */ (loaded.data);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    plainPixels(gl);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32UI, width, height, 0, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.NEAREST);
    this.#textures.set(loaded, texture);
    this.sent += height;
    return texture;
  }
}

/** Words are sent as they are. @param {WebGL2RenderingContext} gl */
function plainPixels(gl) {
  gl.bindBuffer(gl.PIXEL_UNPACK_BUFFER, null);
  gl.pixelStorei(gl.UNPACK_FLIP_Y_WEBGL, false);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
  gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {Program['at']} at
 * @param {Render} render
 * @param {import('../tiles/choose.js').Quad} quad
 */
function setProjection(gl, at, { getProjectionData }, { z, x, y, wrap = 0 }) {
  const tileID = { wrap, canonical: { z, x, y } };
  // versions before 6 have another name for it
  const given = /** @type {any} */ ({ tileID, overscaledTileID: tileID, applyGlobeMatrix: true });
  const { mainMatrix, fallbackMatrix, tileMercatorCoords, clippingPlane, projectionTransition } = getProjectionData(given);
  gl.uniformMatrix4fv(at('u_projection_matrix'), false, mainMatrix);
  gl.uniformMatrix4fv(at('u_projection_fallback_matrix'), false, fallbackMatrix);
  gl.uniform4f(at('u_projection_tile_mercator_coords'), ...tileMercatorCoords);
  gl.uniform4f(at('u_projection_clipping_plane'), ...clippingPlane);
  gl.uniform1f(at('u_projection_transition'), projectionTransition);
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {string} vertex
 * @param {string} fragment
 * @returns {Program}
 */
function linked(gl, vertex, fragment) {
  const program = /** @type {WebGLProgram} */ (gl.createProgram());
  const shaders = [vertex, fragment].map((text, k) => {
    const shader = /** @type {WebGLShader} */ (gl.createShader(k ? gl.FRAGMENT_SHADER : gl.VERTEX_SHADER));
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
    return shader;
  });
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const said = [...shaders.map((shader) => gl.getShaderInfoLog(shader)), gl.getProgramInfoLog(program)].find(Boolean);
    throw new VextureError(`this browser's WebGL refuses the shader of tiles (${line(said)}); update the browser`, 'shader');
  }
  for (const shader of shaders) gl.deleteShader(shader);
  /** @type {Map<string, WebGLUniformLocation | null>} */
  const places = new Map();
  const at = (/** @type {string} */ name) => {
    if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
    return places.get(name) ?? null;
  };
  return { program, at };
}
