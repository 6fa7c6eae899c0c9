// Scenes of node materials on both backends of WebGPURenderer, drawn one at a time as a test describes them.
import * as THREE from 'three/webgpu';
import { uv, vec2, vec4 } from 'three/tsl';
import { WebGLRenderer } from 'three';
import { VectorMaterial, applyVectorMask } from 'vexture';
import * as vexture from 'vexture/webgpu';

const textures = {};
const renderers = {};
const loader = new vexture.VectorTextureLoader();
const complaints = [];
for (const how of ['error', 'warn']) {
  const before = console[how];
  console[how] = (...all) => {
    complaints.push(all.join(' '));
    if (how === 'warn') before.apply(console, all);
  };
}

async function textureOf(name) {
  textures[name] ??= await loader.loadAsync(`${name}.ktx2`);
  return textures[name];
}

async function rendererOf(backend) {
  if (!renderers[backend]) {
    const renderer = new THREE.WebGPURenderer({ forceWebGL: backend === 'webgl', antialias: false });
    renderer.setPixelRatio(1);
    renderer.shadowMap.enabled = true;
    renderer.setClearColor(0x000000, 0);
    await renderer.init();
    if ((renderer.backend.isWebGPUBackend === true) === (backend === 'webgl')) throw new Error(`no ${backend}`);
    renderers[backend] = renderer;
  }
  return renderers[backend];
}

function base64(array) {
  const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  let text = '';
  for (let at = 0; at < bytes.length; at += 32768) text += String.fromCharCode(...bytes.subarray(at, at + 32768));
  return btoa(text);
}

// The pixels of a picture as float32, its top row first.
async function pixelsOf(renderer, scene, camera, [width, height]) {
  const target = new THREE.RenderTarget(width, height, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, width, height);
  renderer.setRenderTarget(null);
  target.dispose();
  if (renderer.backend.isWebGPUBackend === true) return base64(pixels);
  const rows = Array.from({ length: height }, (_, row) => pixels.subarray(4 * width * row, 4 * width * (row + 1)));
  return base64(Float32Array.from(rows.reverse().flatMap((row) => [...row])));
}

// A node over the whole picture: `place` is the part of the unit square that it shows, x, y, width and height.
async function node({ backend, texture, what, options = {}, size = [100, 100], place = [0, 0, 1, 1], turn = 0 }) {
  const renderer = await rendererOf(backend);
  const shape = await textureOf(texture);
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const at = uv().sub(0.5);
  const turned = vec2(at.x.mul(c).sub(at.y.mul(s)), at.x.mul(s).add(at.y.mul(c))).add(0.5);
  const position = turned.mul(vec2(place[2], place[3])).add(vec2(place[0], place[1]));
  const made = vexture[what](shape, { uv: position, ...options });
  const material = new THREE.MeshBasicNodeMaterial();
  material.fragmentNode = what === 'vectorCoverage' ? vec4(made) : made;
  material.blending = THREE.NoBlending;
  const scene = new THREE.Scene();
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material));
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1);
  const pixels = await pixelsOf(renderer, scene, camera, size);
  material.dispose();
  return { pixels, complaints: complaints.splice(0) };
}

function tiltedCamera() {
  const eye = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
  eye.position.set(0, -2.97, 0.37); // 8:1
  eye.lookAt(0, -0.1, 0);
  eye.updateMatrixWorld();
  return eye;
}

// A material over the whole picture, on white; its mask is changed after a first frame, if there are changes.
async function material(scenery) {
  const { backend, texture, type, parameters = {}, mask, changes, recolor, clone, roots, fold, paints, camera = 'flat', size } = scenery;
  const renderer = await rendererOf(backend);
  const shape = texture && (await textureOf(texture));
  if (fold) {
    const given = await new vexture.FoldLoader().loadAsync(`${fold}.fold.ktx2`);
    if (mask) mask.fold = given;
    else parameters.fold = given;
  }
  if (mask?.transform) mask.transform = new THREE.Matrix3().set(...mask.transform);
  let made = type === 'VectorNodeMaterial' ? new vexture[type]({ texture: shape, ...parameters }) : new THREE[type](parameters);
  if (mask) vexture.applyVectorMask(made, shape, mask);
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xffffff);
  const geometry = new THREE.PlaneGeometry(roots ? 1 : 2, roots ? 1 : 2);
  if (roots) geometry.setAttribute('vextureRoot', vexture.rootAttribute(shape, roots));
  if (clone) made = made.clone();
  const mesh = roots ? new THREE.InstancedMesh(geometry, made, roots.length) : new THREE.Mesh(geometry, made);
  const thing = made.isSpriteMaterial ? new THREE.Sprite(made) : mesh;
  if (made.isSpriteMaterial) thing.scale.setScalar(2);
  for (let i = 0; i < (roots?.length ?? 0); i++) {
    mesh.setMatrixAt(i, new THREE.Matrix4().makeTranslation((i % 2) - 0.5, 0.5 - Math.floor(i / 2), 0));
  }
  scene.add(thing, new THREE.AmbientLight(0xffffff, Math.PI));
  const eye = camera === 'flat' ? new THREE.OrthographicCamera(-1, 1, 1, -1, -5, 5) : tiltedCamera();
  let pixels = await pixelsOf(renderer, scene, eye, size);
  if (paints) {
    shape.setPaints(paints);
    pixels = await pixelsOf(renderer, scene, eye, size);
    shape.setPaints(Object.fromEntries(Object.keys(paints).map((name) => [name, 'own'])));
  }
  if (recolor !== undefined) {
    made.color.set(recolor);
    pixels = await pixelsOf(renderer, scene, eye, size);
  }
  if (changes) {
    const target = vexture.vectorMaskOf(made) ?? made;
    for (const [name, value] of Object.entries(changes)) target[name] = name === 'texture' ? await textureOf(value) : value;
    pixels = await pixelsOf(renderer, scene, eye, size);
  }
  made.dispose();
  return { pixels, complaints: complaints.splice(0) };
}

// The shadow of a masked plane on a white ground, seen from above: 1 where light falls.
async function shadow({ backend, texture, mask = {}, size = [200, 200] }) {
  const renderer = await rendererOf(backend);
  const scene = new THREE.Scene();
  const sun = new THREE.DirectionalLight(0xffffff, Math.PI);
  sun.position.set(0, 0, 3);
  sun.castShadow = true;
  sun.shadow.mapSize.set(1024, 1024);
  Object.assign(sun.shadow.camera, { left: -1.2, right: 1.2, bottom: -1.2, top: 1.2, near: 0.1, far: 10 });
  const ground = new THREE.Mesh(new THREE.PlaneGeometry(4, 4), new THREE.MeshLambertNodeMaterial({ color: 0xffffff }));
  ground.receiveShadow = true;
  ground.position.z = -1;
  const made = new THREE.MeshLambertNodeMaterial({ color: 0xffffff, side: THREE.DoubleSide });
  const mesh = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), made);
  vexture.applyVectorMask(made, await textureOf(texture), mask);
  mesh.castShadow = true;
  scene.add(sun, ground, mesh);
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
  camera.position.z = -0.5; // below the plane, above its shadow
  const pixels = await pixelsOf(renderer, scene, camera, size);
  return { pixels, complaints: complaints.splice(0) };
}

// A material whose texture gets other data, and whether it was compiled again.
async function live({ backend, size }) {
  const renderer = await rendererOf(backend);
  const shape = (await textureOf('duck')).clone();
  const made = new vexture.VectorNodeMaterial({ texture: shape, color: 0 });
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xffffff);
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), made));
  const eye = new THREE.OrthographicCamera(-1, 1, 1, -1, -5, 5);
  await pixelsOf(renderer, scene, eye, size);
  const { version } = made;
  shape.replace((await textureOf('cake')).data);
  const pixels = await pixelsOf(renderer, scene, eye, size);
  const said = complaints.splice(0);
  return { pixels, complaints: made.version === version ? said : [...said, 'compiled again'] };
}

// A node over the whole picture, whose texture gets other data after a first frame.
async function liveNode({ backend, what, first, then, size }) {
  const renderer = await rendererOf(backend);
  const shape = (await textureOf(first)).clone();
  const made = new THREE.MeshBasicNodeMaterial();
  made.fragmentNode = vexture[what](shape);
  made.blending = THREE.NoBlending;
  const scene = new THREE.Scene();
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), made));
  const eye = new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1);
  await pixelsOf(renderer, scene, eye, size);
  shape.replace((await textureOf(then)).data);
  const pixels = await pixelsOf(renderer, scene, eye, size);
  made.dispose();
  return { pixels, complaints: complaints.splice(0) };
}

// The same tilted plane by WebGLRenderer and its own material.
async function webglTilted({ texture, size }) {
  const renderer = new WebGLRenderer({ alpha: true });
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xffffff);
  const shape = (await textureOf(texture)).clone();
  scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new VectorMaterial({ texture: shape, color: 0 })));
  const target = new THREE.WebGLRenderTarget(...size, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.render(scene, tiltedCamera());
  const pixels = new Float32Array(4 * size[0] * size[1]);
  renderer.readRenderTargetPixels(target, 0, 0, ...size, pixels);
  renderer.dispose();
  const rows = Array.from({ length: size[1] }, (_, row) => pixels.subarray(4 * size[0] * row, 4 * size[0] * (row + 1)));
  return { pixels: base64(Float32Array.from(rows.reverse().flatMap((row) => [...row]))), complaints: complaints.splice(0) };
}

// What is said where a material meets the wrong renderer.
async function wrong({ backend, texture }) {
  const shape = await textureOf(texture);
  const scene = new THREE.Scene();
  const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1, 1);
  const said = [];
  const trying = (act) => {
    try {
      act();
    } catch (error) {
      said.push(String(error.message));
    }
  };
  if (backend === 'webgl only') {
    const renderer = new WebGLRenderer();
    scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new vexture.VectorNodeMaterial({ texture: shape })));
    trying(() => renderer.render(scene, camera));
    renderer.dispose();
  } else {
    const renderer = await rendererOf(backend);
    scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new VectorMaterial({ texture: shape })));
    trying(() => renderer.render(scene, camera));
    trying(() => applyVectorMask(new THREE.MeshStandardNodeMaterial(), shape));
    trying(() => vexture.applyVectorMask(new THREE.MeshStandardMaterial(), shape));
    trying(() => vexture.vectorColor(shape, { wrap: 'mirror' }));
    trying(() => vexture.vectorColor(shape, { fold: {} }));
    trying(() => vexture.vectorCoverage(shape, { colour: 1 }));
  }
  return { said, complaints: complaints.splice(0) };
}

globalThis.drawn = { node, material, shadow, live, liveNode, webglTilted, wrong };
