import * as globe from 'vexture/globe';

Object.assign(globalThis.galleryModules, { 'vexture/globe': globe });
