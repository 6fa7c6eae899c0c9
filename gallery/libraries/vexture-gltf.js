import * as loader from 'three/addons/loaders/GLTFLoader.js';
import * as vexture from 'vexture';
import * as gltf from 'vexture/gltf';

Object.assign(globalThis.galleryModules, {
  vexture, 'vexture/gltf': gltf, 'three/addons/loaders/GLTFLoader.js': loader,
});
