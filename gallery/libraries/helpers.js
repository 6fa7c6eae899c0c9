import * as helpers from '../pages/helpers.js';

Object.assign(globalThis.galleryModules, { './helpers.js': helpers });
