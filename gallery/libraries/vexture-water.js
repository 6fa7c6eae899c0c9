import * as vexture from 'vexture';
import * as water from 'vexture/water';

Object.assign(globalThis.galleryModules, { vexture, 'vexture/water': water });
