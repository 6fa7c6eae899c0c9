import * as vexture from 'vexture';

Object.assign(globalThis.galleryModules, { vexture });
