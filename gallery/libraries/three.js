import * as three from 'three';
import * as controls from 'three/addons/controls/OrbitControls.js';

globalThis.galleryModules = { three, 'three/addons/controls/OrbitControls.js': controls };
