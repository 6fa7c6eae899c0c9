// A bay with a beach, drawn one picture at a time as a test describes it.
import * as THREE from 'three';
import { Water } from 'three/addons/objects/Water.js';
import { FoldTexture, VectorTextureLoader } from 'vexture';
import { SimpleWater, VectorWater, waterNormals } from 'vexture/water';

const SIDE = 100; // of the plane, whose uv are the unit square
const SUN = new THREE.Vector3(-0.5, 0.42, -0.75).normalize();

const loader = new VectorTextureLoader();
const textures = {};
const textureOf = async (name) => (textures[name] ??= await loader.loadAsync(`${name}.ktx2`));

const folds = {};
const foldOf = async (name) => (folds[name] ??= FoldTexture.parse(await (await fetch(`${name}.fold.ktx2`)).arrayBuffer()));

let renderer = null;

function rendererOf({ width = 512, height = 512, toneMapping = 'NoToneMapping' }) {
  if (!renderer) {
    renderer = new THREE.WebGLRenderer({ antialias: false });
    renderer.setPixelRatio(1);
    document.body.replaceChildren(renderer.domElement);
  }
  renderer.setSize(width, height);
  renderer.toneMapping = THREE[toneMapping];
  return renderer;
}

const CAMERAS = {
  sky: [[0, 120, 0.01], [0, 0, 0], 50],
  bird: [[0, 30, 70], [0, 0, 0], 45],
  coast: [[22, 9, 34], [-8, 0, 2], 50],
  shore: [[17, 2.2, 22], [0, 0.5, 0], 55],
  beach: [[13, 0.8, 21.5], [-3, 0.6, 5], 60],
};

function cameraOf({ camera = 'flat', width = 512, height = 512 }) {
  if (camera === 'flat') {
    const flat = new THREE.OrthographicCamera(-SIDE / 2, SIDE / 2, SIDE / 2, -SIDE / 2, 0, 100);
    flat.position.y = 50;
    flat.rotation.x = -Math.PI / 2; // lookAt does not look down quite upright
    return flat;
  }
  const [place, at, angle] = CAMERAS[camera];
  const seen = new THREE.PerspectiveCamera(angle, width / height, 0.05, 2000);
  seen.position.set(...place);
  seen.lookAt(...at);
  return seen;
}

const planeOf = () => new THREE.PlaneGeometry(SIDE, SIDE);

function lay(mesh, y = 0) {
  mesh.rotation.x = -Math.PI / 2;
  mesh.position.y = y;
  return mesh;
}

function sandOf(size = 256) {
  const data = new Uint8Array(4 * size * size);
  let state = 1;
  for (let i = 0; i < size * size; i++) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    const grain = 0.9 + 0.1 * (state / 2 ** 32);
    data.set([222 * grain, 202 * grain, 160 * grain, 255], 4 * i);
  }
  const sand = new THREE.DataTexture(data, size, size);
  sand.colorSpace = THREE.SRGBColorSpace;
  sand.wrapS = sand.wrapT = THREE.RepeatWrapping;
  sand.repeat.set(40, 40);
  sand.magFilter = THREE.LinearFilter;
  sand.minFilter = THREE.LinearMipmapLinearFilter;
  sand.generateMipmaps = true;
  sand.anisotropy = 8;
  sand.needsUpdate = true;
  return sand;
}

function skyOf() {
  const geometry = new THREE.SphereGeometry(900, 24, 24);
  const colors = [];
  const [low, high, color] = [new THREE.Color(0xdfe9ee), new THREE.Color(0x4f8ccc), new THREE.Color()];
  for (let i = 0; i < geometry.attributes.position.count; i++) {
    const y = Math.max(geometry.attributes.position.getY(i) / 900, 0);
    color.lerpColors(low, high, Math.min(1, y * 1.6) ** 0.6).toArray(colors, 3 * i);
  }
  geometry.setAttribute('color', new THREE.Float32BufferAttribute(colors, 3));
  return new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.BackSide, fog: false }));
}

function fill(scene, { ground }) {
  if (ground !== undefined) {
    scene.background = new THREE.Color(ground);
    return;
  }
  const light = new THREE.DirectionalLight(0xfff2e0, 2.2);
  light.position.copy(SUN);
  scene.add(light, new THREE.HemisphereLight(0xcfe4ff, 0x8f7f60, 1.1), skyOf());
  scene.add(lay(new THREE.Mesh(planeOf(), new THREE.MeshLambertMaterial({ map: sandOf() })), -0.03));
  const hill = new THREE.Mesh(new THREE.SphereGeometry(9, 32, 16), new THREE.MeshLambertMaterial({ color: 0x5b7348 }));
  hill.scale.y = 0.5;
  hill.position.set(-30, 0, -38);
  const post = new THREE.Mesh(new THREE.CylinderGeometry(0.4, 0.4, 5), new THREE.MeshLambertMaterial({ color: 0xb03020 }));
  post.position.set(-4, 1, 4);
  scene.add(hill, post);
}

const normals = waterNormals();

const LOOK = { waterColor: 0x0b5068, sunColor: 0x9fb0b8, sunDirection: SUN, distortionScale: 3, size: 12 };

function rasterOf(texture) {
  const size = 1024;
  const data = new Uint8Array(size * size);
  for (let y = 0; y < size; y++) {
    for (let x = 0; x < size; x++) data[y * size + x] = texture.contains((x + 0.5) / size, (y + 0.5) / size) ? 255 : 0;
  }
  const raster = new THREE.DataTexture(data, size, size, THREE.RedFormat);
  raster.magFilter = THREE.LinearFilter;
  raster.minFilter = THREE.LinearMipmapLinearFilter;
  raster.generateMipmaps = true;
  raster.needsUpdate = true;
  return raster;
}

// The same water by two lookups in an image of the shape.
const RASTER = `uniform sampler2D raster;
VextureWater rasterWater(vec2 uv, vec2 dx, vec2 dy) {
  vec2 reach = abs(dx) + abs(dy);
  float box = 2.0 * vextureShore;
  float clarity = clamp(2.0 - 2.0 * max(reach.x, reach.y) / box, 0.0, 1.0);
  float coverage = texture2D(raster, uv).r;
  float around = textureGrad(raster, uv, vec2(box, 0.0), vec2(0.0, box)).r;
  float offshore = mix(1.0, clamp(2.0 * around - 1.0, 0.0, 1.0), clarity);
  float widths = 1.0 / vextureShore;
  return VextureWater(coverage, offshore, smoothstep(0.2, 0.45, around), uv * widths, dx * widths, dy * widths);
}
void main() {`;

function rastered(water) {
  const { material } = water;
  material.fragmentShader = material.fragmentShader
    .replace('void main() {', RASTER)
    .replaceAll('= vextureWater(', '= rasterWater(');
  material.uniforms.raster = { value: rasterOf(water.texture) };
}

async function waterOf({ water = 'vector', texture = 'bay', options = {}, transform, fold, time = 3, patch = [] }) {
  if (water === 'none') return new THREE.Group();
  const own = { waterNormals: normals, ...LOOK, ...options };
  if (transform) own.transform = new THREE.Matrix3().set(...transform);
  if (fold) own.fold = await foldOf(fold);
  let mesh;
  if (water === 'plain') {
    mesh = new Water(planeOf(), own);
    mesh.material.uniforms.size.value = own.size;
    mesh.material.uniforms.time.value = time;
  } else {
    const kind = water === 'simple' ? SimpleWater : VectorWater;
    mesh = new kind(planeOf(), texture && (await textureOf(texture)), own);
    mesh.time = time;
    if (water === 'raster') rastered(mesh);
    for (const [from, to] of patch) {
      if (!mesh.material.fragmentShader.includes(from)) throw new Error(`the shader lacks ${from}`);
      mesh.material.fragmentShader = mesh.material.fragmentShader.replace(from, to);
    }
  }
  return mesh;
}

async function build(config) {
  const scene = new THREE.Scene();
  fill(scene, config);
  const camera = cameraOf(config);
  const water = lay(await waterOf(config));
  scene.add(water);
  camera.updateMatrixWorld();
  scene.updateMatrixWorld();
  return { scene, camera, water };
}

function pixels({ width = 512, height = 512 }) {
  const gl = renderer.getContext();
  const data = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  let text = '';
  for (let i = 0; i < data.length; i += 4096) text += String.fromCharCode(...data.subarray(i, i + 4096));
  return btoa(text);
}

async function draw(config) {
  const { scene, camera, water } = await build(config);
  rendererOf(config).render(scene, camera);
  const picture = pixels(config);
  const matrix = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).multiply(water.matrixWorld);
  water.dispose?.();
  return { picture, matrix: matrix.elements };
}

// The driver loses all that is on it, and comes back.
async function lose() {
  const extension = renderer.getContext().getExtension('WEBGL_lose_context');
  for (const [change, event] of [['loseContext', 'webglcontextlost'], ['restoreContext', 'webglcontextrestored']]) {
    const changed = new Promise((done) => renderer.domElement.addEventListener(event, done, { once: true }));
    extension[change]();
    await changed;
    await new Promise((done) => setTimeout(done));
  }
}

// Pictures of one water after each of some changes: to properties, a texture's name, a fade, other data of a texture, a
// driver that is lost.
async function changes(config, steps) {
  const { scene, camera, water } = await build(config);
  const pictures = [];
  rendererOf(config);
  if (config.part) {
    renderer.setViewport(...config.part);
    renderer.setScissor(...config.part);
    renderer.setScissorTest(true);
    renderer.autoClear = false;
  }
  for (const step of steps) {
    for (const [key, value] of Object.entries(step)) {
      if (key === 'texture') water.texture = value && (await textureOf(value));
      else if (key === 'fadeTo') water.fadeTo(value && (await textureOf(value)));
      else if (key === 'lost') await lose();
      else if (key === 'replace') water.texture.replace((await loader.loadAsync(`${value}.ktx2`)).data);
      else water[key] = value;
    }
    if (config.part) renderer.clear();
    renderer.render(scene, camera);
    pictures.push(pixels(config));
  }
  return { pictures, programs: renderer.info.programs.filter(({ name }) => name === water.material.name).length };
}

// Milliseconds of frames of several waters, which take turns in one scene.
async function times(configs, rounds, frames) {
  const built = [];
  for (const config of configs) built.push(await build(config));
  const gl = rendererOf(configs[0]).getContext();
  const pixel = new Uint8Array(4);
  const found = configs.map(() => []);
  for (let round = -1; round < rounds; round++) {
    built.forEach(({ scene, camera, water }, i) => {
      const start = performance.now();
      for (let frame = 0; frame < frames; frame++) {
        if ('time' in water) water.time = 3 + round + frame / 60;
        renderer.render(scene, camera);
        gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      }
      if (round >= 0) found[i].push((performance.now() - start) / frames);
    });
  }
  return found;
}

// Frames of some kept scenes, whose cost somebody measures.
let kept = [];

async function keep(configs) {
  kept = [];
  for (const config of configs) kept.push(await build(config));
  rendererOf(configs[0]);
}

function frames(i, count) {
  const { scene, camera, water } = kept[i];
  const gl = renderer.getContext();
  for (let frame = 0; frame < count; frame++) {
    if ('time' in water) water.time = 3 + frame / 60;
    renderer.render(scene, camera);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}

window.page = { keep, frames, draw, changes, times };
