import * as maplibre from 'maplibre-gl';
import style from 'maplibre-gl/dist/maplibre-gl.css' with { type: 'text' };
import worker from 'maplibre-gl/dist/maplibre-gl-worker.mjs' with { type: 'text' };
import * as vexture from 'vexture/maplibre';

document.head.append(Object.assign(document.createElement('style'), { textContent: style }));
// a page from the disk may not start a file as a worker
maplibre.setWorkerUrl(URL.createObjectURL(new Blob([worker], { type: 'text/javascript' })));
globalThis.galleryModules = { 'maplibre-gl': maplibre, 'vexture/maplibre': vexture };
