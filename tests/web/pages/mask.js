// Scenes with masked materials, drawn one at a time as a test describes them.
import * as THREE from 'three';
import { FoldTexture, VectorMaterial, VectorTextureLoader, VextureError, applyVectorMask, rootAttribute, vectorMaskOf } from 'vexture';
import { ThesisLoader } from 'vexture/thesis';

const textures = {};
const folds = {};
const renderers = {};

const loader = new VectorTextureLoader();

function load(name) {
  return name === 'thesis' ? new ThesisLoader().loadAsync(name) : loader.loadAsync(`${name}.ktx2`);
}

async function textureOf(name) {
  textures[name] ??= await load(name);
  return textures[name];
}

// Options of a mask whose fold is named.
async function folded(mask) {
  if (typeof mask?.fold !== 'string') return mask;
  const file = `${mask.fold}.fold.ktx2`;
  folds[file] ??= await FoldTexture.parse(await (await fetch(file)).arrayBuffer(), file);
  return { ...mask, fold: folds[file] };
}

function rendererOf({ logarithmicDepthBuffer = false }) {
  const key = String(logarithmicDepthBuffer);
  if (!renderers[key]) {
    renderers[key] = new THREE.WebGLRenderer({ logarithmicDepthBuffer, antialias: false });
    renderers[key].setPixelRatio(1);
    document.body.replaceChildren(renderers[key].domElement);
  }
  return renderers[key];
}

function cameraOf({ camera = 'flat' }) {
  if (camera === 'flat') {
    const flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
    flat.position.z = 5;
    return flat;
  }
  const tilted = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
  tilted.position.set(0, -2.97, 0.37); // 8:1
  tilted.lookAt(0, -0.1, 0);
  return tilted;
}

// a map of four by four colours
function mapOf(seed) {
  const data = Uint8Array.from({ length: 64 }, (_, i) => (i % 4 === 3 ? 255 : (i * seed * 37) % 256));
  const map = new THREE.DataTexture(data, 4, 4);
  map.colorSpace = THREE.SRGBColorSpace;
  map.needsUpdate = true;
  return map;
}

function completed(parameters) {
  const result = { ...parameters };
  for (const key of ['map', 'matcap']) if (result[key]) result[key] = mapOf(result[key]);
  if (result.transform) result.transform = new THREE.Matrix3().fromArray(result.transform).transpose();
  return result;
}

function meshOf(config, material, texture) {
  if (material.isSpriteMaterial) {
    const sprite = new THREE.Sprite(material);
    sprite.scale.set(2, 2, 1);
    return sprite;
  }
  const [w, h] = config.plane ?? [2, 2];
  const geometry = new THREE.PlaneGeometry(w, h);
  if (!config.instances) return new THREE.Mesh(geometry, material);
  geometry.setAttribute('vextureRoot', rootAttribute(texture, config.instances));
  const mesh = new THREE.InstancedMesh(geometry, material, 4);
  for (let i = 0; i < 4; i++) {
    mesh.setMatrixAt(i, new THREE.Matrix4().makeTranslation(i % 2 ? 0.5 : -0.5, i < 2 ? 0.5 : -0.5, 0));
  }
  return mesh;
}

function chain(material) {
  material.onBeforeCompile = (shader) => {
    shader.fragmentShader = shader.fragmentShader.replace(
      '#include <color_fragment>',
      '#include <color_fragment>\ndiffuseColor.rgb = diffuseColor.brg;',
    );
  };
}

async function build(config) {
  const texture = await textureOf(config.texture ?? 'duck');
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(config.background ?? 0xffffff);
  if (config.fog) scene.fog = new THREE.Fog(0x3060a0, 1, 8);
  const light = new THREE.DirectionalLight(0xffffff, 2);
  light.position.set(1, 2, 5);
  scene.add(light, new THREE.AmbientLight(0xffffff, 0.5));
  let material;
  let mask = null;
  const options = await folded(config.mask);
  if (config.material === 'VectorMaterial') {
    material = new VectorMaterial({ texture, ...completed(config.parameters), ...completed(options) });
    if (config.clone) material = material.clone();
    mask = material.mask;
  } else {
    material = new THREE[config.material ?? 'MeshBasicMaterial'](completed(config.parameters ?? {}));
    if (config.chain === 'before') chain(material);
    if (options) mask = applyVectorMask(material, texture, completed(options));
    if (options && config.clone) {
      material = material.clone();
      mask = vectorMaskOf(material);
    }
    if (config.chain === 'after') chain(material);
  }
  const mesh = meshOf(config, material, texture);
  if (mask) mask.attach(mesh);
  scene.add(mesh);
  const camera = cameraOf(config);
  camera.updateMatrixWorld();
  scene.updateMatrixWorld();
  return { scene, camera, mesh, mask, material, texture };
}

function pixels(renderer, size) {
  const gl = renderer.getContext();
  const data = new Uint8Array(4 * size * size);
  gl.readPixels(0, 0, size, size, gl.RGBA, gl.UNSIGNED_BYTE, data);
  let text = '';
  for (let i = 0; i < data.length; i += 4096) text += String.fromCharCode(...data.subarray(i, i + 4096));
  return btoa(text);
}

function render(config, { scene, camera }) {
  const renderer = rendererOf(config);
  const size = config.size ?? 512;
  renderer.setSize(size, size);
  renderer.toneMapping = THREE[config.toneMapping ?? 'NoToneMapping'];
  renderer.outputColorSpace = THREE[config.output ?? 'SRGBColorSpace'];
  renderer.shadowMap.enabled = Boolean(config.shadow);
  renderer.shadowMap.type = THREE.BasicShadowMap;
  renderer.render(scene, camera);
  return pixels(renderer, size);
}

async function draw(config) {
  const built = await build(config);
  const { camera, mesh } = built;
  const picture = render(config, built);
  const matrix = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).multiply(mesh.matrixWorld);
  return { picture, matrix: matrix.elements };
}

// A picture for each time of the fold, and what rays through some places of the mesh meet then.
async function frames(config, times, places = []) {
  const built = await build(config);
  const { mask, camera, mesh } = built;
  const matrix = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse).multiply(mesh.matrixWorld);
  const found = times.map((time) => {
    mask.time = time;
    return { picture: render(config, built), hits: places.map(([u, v]) => mask.hits(u, v)) };
  });
  return { frames: found, matrix: matrix.elements, programs: rendererOf(config).info.programs.length };
}

// The shadow of the shape on a ground below it, the shape itself not being seen.
async function shadow(config) {
  const built = await build(config);
  const { scene, mesh, material } = built;
  scene.clear();
  material.colorWrite = false;
  material.depthWrite = false;
  material.side = THREE.DoubleSide;
  mesh.castShadow = true;
  mesh.position.z = 1;
  const ground = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new THREE.MeshLambertMaterial());
  ground.receiveShadow = true;
  const isPoint = config.shadow === 'point';
  const light = isPoint ? new THREE.PointLight(0xffffff, 20, 0, 0) : new THREE.DirectionalLight(0xffffff, 3);
  light.position.set(0, 0, isPoint ? 3 : 4);
  light.castShadow = true;
  light.shadow.mapSize.set(1024, 1024);
  if (light.isDirectionalLight) Object.assign(light.shadow.camera, { left: -1.2, right: 1.2, top: 1.2, bottom: -1.2 });
  scene.add(ground, mesh, light);
  return render(config, built);
}

// Which of the centres of count x count squares of the picture a ray hits, from the top left.
async function rays(config, count) {
  const { camera, mesh, scene } = await build(config);
  scene.updateMatrixWorld();
  const caster = new THREE.Raycaster();
  const hits = []; // on its diagonal both triangles of a plane are hit
  for (let i = 0; i < count * count; i++) {
    const place = new THREE.Vector2(((i % count) + 0.5) / count, (Math.floor(i / count) + 0.5) / count);
    caster.setFromCamera(place.multiplyScalar(2).addScalar(-1).multiply(new THREE.Vector2(1, -1)), camera);
    hits.push(Math.min(caster.intersectObject(mesh).length, 1));
  }
  return hits;
}

// A picture before, one after each change, and one after everything was taken back.
async function changes(config, steps) {
  const built = await build({ ...config, texture: undefined });
  const own = await load(config.texture);
  built.mask.texture = own;
  const pictures = [render(config, built)];
  for (const step of steps) {
    if (step.replace) own.replace((await load(step.replace)).data);
    else if (step.texture) built.mask.texture = await textureOf(step.texture);
    else if (step.remove) built.mask.remove();
    else Object.assign(built.mask, completed(step));
    pictures.push(render(config, built));
  }
  return pictures;
}

async function loseContext(renderer) {
  const extension = renderer.getContext().getExtension('WEBGL_lose_context');
  const canvas = renderer.domElement;
  const lost = new Promise((done) => canvas.addEventListener('webglcontextlost', done, { once: true }));
  extension.loseContext();
  await lost;
  await new Promise((done) => setTimeout(done));
  const restored = new Promise((done) => canvas.addEventListener('webglcontextrestored', done, { once: true }));
  extension.restoreContext();
  await restored;
}

async function loss(config) {
  const built = await build(config);
  const before = render(config, built);
  await loseContext(rendererOf(config));
  return [before, render(config, built)];
}

// A picture after each of some new colours, which another renderer misses; what it shows then; and both after the last
// colours, of which the first renderer hears together with the loss of its context.
async function recolors(config, all) {
  const built = await build({ ...config, texture: undefined });
  built.mask.texture = await load(config.texture);
  const [one, two] = [config, { ...config, logarithmicDepthBuffer: true }];
  const pictures = [];
  render(two, built);
  for (const paints of all.slice(0, -1)) {
    built.mask.texture.setPaints(paints);
    pictures.push(render(one, built));
  }
  built.mask.texture.setPaints(all.at(-1));
  pictures.push(render(two, built));
  built.mask.texture.setPaints(all.at(-1));
  await loseContext(rendererOf(one));
  pictures.push(render(one, built));
  return pictures;
}

async function refusals() {
  const texture = await textureOf('duck');
  const atlas = await textureOf('atlas');
  const thesis = await textureOf('thesis');
  const masked = new THREE.MeshBasicMaterial({ name: 'sea' });
  const first = applyVectorMask(masked, texture);
  const attempts = {
    twice: () => applyVectorMask(masked, texture),
    include: () => applyVectorMask(new THREE.PointsMaterial(), texture),
    shader: () => applyVectorMask(new THREE.ShaderMaterial(), texture),
    mode: () => applyVectorMask(new THREE.MeshBasicMaterial(), texture, { mode: 'glow' }),
    colorless: () => applyVectorMask(new THREE.MeshNormalMaterial(), texture, { mode: 'paint' }),
    root: () => applyVectorMask(new THREE.MeshBasicMaterial(), texture, { root: 'dukc' }),
    several: () => applyVectorMask(new THREE.MeshBasicMaterial(), atlas),
    thesis: () => applyVectorMask(new THREE.MeshBasicMaterial(), thesis, { wrap: 'repeat' }),
    mesh: () => first.attach(new THREE.Mesh(new THREE.BoxGeometry(), [masked, masked])),
    setter: () => (first.wrap = 'mirror'),
  };
  const outcomes = {};
  for (const [name, attempt] of Object.entries(attempts)) {
    try {
      attempt();
      outcomes[name] = null;
    } catch (error) {
      outcomes[name] = error instanceof VextureError ? [error.field, error.message] : String(error);
    }
  }
  outcomes.wrap = first.wrap;
  first.remove();
  applyVectorMask(masked, texture);
  return outcomes;
}

window.page = { draw, frames, shadow, rays, changes, loss, recolors, refusals, revision: THREE.REVISION };
