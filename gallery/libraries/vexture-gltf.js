import * as room from 'three/addons/environments/RoomEnvironment.js';
import * as loader from 'three/addons/loaders/GLTFLoader.js';
import * as vexture from 'vexture';
import * as gltf from 'vexture/gltf';

Object.assign(globalThis.galleryModules, {
  vexture, 'vexture/gltf': gltf, 'three/addons/environments/RoomEnvironment.js': room, 'three/addons/loaders/GLTFLoader.js': loader,
});
