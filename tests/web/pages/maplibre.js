// A map of MapLibre with the tiles of the tests. `maplibregl` comes from its own files, since it starts workers by their place.
import { VectorTileLayer } from 'vexture/maplibre';

window.open_ = async (maplibregl, options, { before, ...layer } = {}) => {
  const style = { version: 8, projection: { type: options.projection ?? 'mercator' }, sources: {},
    layers: [{ id: 'ground', type: 'background', paint: { 'background-color': '#ffffff' } }] };
  const map = new maplibregl.Map({ container: 'map', style, attributionControl: false, fadeDuration: 0, pixelRatio: 1,
    canvasContextAttributes: { preserveDrawingBuffer: true, antialias: false }, maxPitch: 70, ...options });
  await new Promise((resolve) => map.once('load', resolve));
  const tiles = new VectorTileLayer({ id: 'tiles', source: 'map.pmtiles', pause: 10, ...layer });
  window.events = [];
  for (const type of ['hover', 'click', 'error']) tiles.on(type, (event) => window.events.push([type, event.feature?.id ?? String(event.error ?? '')]));
  map.addLayer(tiles, before);
  Object.assign(window, { map, tiles, maplibregl });
  await tiles.ready().catch(() => {});
  await window.settled();
};

window.settled = async () => {
  do await window.frame();
  while (tiles.stats.running && (await new Promise((resolve) => setTimeout(resolve, 5, true))));
  await window.frame();
};

window.frame = () => new Promise((resolve) => { map.once('render', resolve); map.triggerRepaint(); });

// How many pixels of the next frame have a colour.
window.count = async (...color) => {
  await window.frame();
  const gl = map.getCanvas().getContext('webgl2');
  const data = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
  gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, data);
  let found = 0;
  for (let at = 0; at < data.length; at += 4) found += color.every((part, c) => data[at + c] === part);
  return found;
};

// Pixels RGB, top row first.
window.pixels = async () => {
  await window.frame();
  const gl = map.getCanvas().getContext('webgl2');
  const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
  const data = new Uint8Array(4 * width * height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  let text = '';
  for (let at = 0; at < data.length; at += 4096) text += String.fromCharCode(...data.subarray(at, at + 4096));
  return { width, height, data: btoa(text) };
};
