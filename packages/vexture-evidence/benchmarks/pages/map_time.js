// A map of counties through time: what a step costs the page's thread.
import { Map } from 'maplibre-gl';
import { VectorTileLayer } from 'vexture/maplibre';

const median = (some) => some.toSorted((one, other) => one - other)[some.length >> 1];

// Milliseconds of a layer's frames and of setTimes; `frames` frames at each of `months` times, and as many without a change.
window.measured = async (view, ids, months) => {
  const map = new Map({ container: 'map', style: { version: 8, sources: {}, layers: [] }, fadeDuration: 0, attributionControl: false,
    ...view });
  await new Promise((resolve) => map.once('load', resolve));
  const layer = new VectorTileLayer({ id: 'counties', source: 'counties/tiles.json' });
  const frame = () => new Promise((resolve) => { map.once('render', resolve); map.triggerRepaint(); });
  const spent = [];
  const render = layer.render.bind(layer);
  layer.render = (gl, given) => {
    const start = performance.now();
    render(gl, given);
    spent.push(performance.now() - start);
    gl.finish(); // what is drawn in software is not to delay the next frame
  };
  map.addLayer(layer);
  await layer.ready();
  do {
    await frame();
    await new Promise((resolve) => setTimeout(resolve, 20));
  } while (layer.stats.running || !layer.stats.shown.length);
  const colors = Array.from({ length: months }, (_, month) =>
    ids.map((id, k) => `rgb(${(37 * k + 2 * month) % 256}, ${(11 * k + month) % 256}, ${(5 * k) % 256})`));
  const begun = performance.now();
  layer.setTimes({ ids, colors });
  const given = performance.now() - begun;
  const framed = async (timeOf) => {
    const each = [];
    for (let month = 0; month < months; month++) {
      spent.length = 0;
      const start = performance.now();
      layer.setTime(timeOf(month));
      const set = performance.now() - start;
      await frame();
      each.push(set + spent.at(-1));
    }
    return each;
  };
  const [first] = await framed(() => 0.5);
  const rows = layer.stats.rowsSent;
  const changed = await framed((month) => month + 0.25);
  const sent = layer.stats.rowsSent - rows;
  const still = await framed(() => months);
  return { given, first, step: median(changed), slowest: Math.max(...changed), still: median(still), rows: sent / months,
    shown: new Set(layer.stats.shown.map(({ tile }) => JSON.stringify(tile))).size };
};
