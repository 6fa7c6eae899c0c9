import * as controls from 'three/addons/controls/OrbitControls.js';
import * as tsl from 'three/tsl';
import * as three from 'three/webgpu';
import * as vexture from 'vexture/webgpu';

globalThis.galleryModules = {
  'three/webgpu': three, 'three/tsl': tsl, 'vexture/webgpu': vexture, 'three/addons/controls/OrbitControls.js': controls,
};
