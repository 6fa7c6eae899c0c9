import { AttributionControl, Map, Marker } from 'maplibre-gl';
import { VectorTileLayer } from 'vexture/maplibre';

document.body.insertAdjacentHTML('beforeend', `<div id="map" style="height: 100%"></div>
  <div style="position: fixed; left: 1rem; top: 1rem; padding: .5rem .8rem; border-radius: .5rem; background: #fffd; width: 13rem">
    <strong id="month" style="display: block"></strong> <output id="name"></output>
    <input id="time" type="range" min="0" max="119" step="any" value="0" aria-label="Month" style="width: 100%"></div>`);
const [month, name, slider] = ['month', 'name', 'time'].map((id) => document.getElementById(id));

const cities = { Seattle: [-122.33, 47.61], 'Los Angeles': [-118.24, 34.05], Denver: [-104.99, 39.74], Houston: [-95.37, 29.76],
  Chicago: [-87.63, 41.88], Miami: [-80.19, 25.76], 'New York': [-74.01, 40.71], Anchorage: [-149.9, 61.22] };
const features = Object.entries(cities).map(([label, coordinates]) =>
  ({ type: 'Feature', properties: { label }, geometry: { type: 'Point', coordinates } }));
const map = new Map({
  container: 'map', bounds: [[-125, 24], [-66.5, 49.5]], fitBoundsOptions: { padding: 20 }, maxZoom: 14, attributionControl: false,
  style: {
    version: 8,
    sources: { cities: { type: 'geojson', data: { type: 'FeatureCollection', features } } },
    layers: [
      { id: 'ground', type: 'background', paint: { 'background-color': '#dbe5ea' } },
      { id: 'labels', type: 'symbol', source: 'cities', layout: { 'text-field': ['get', 'label'], 'text-size': 14 },
        paint: { 'text-color': '#1c2733', 'text-halo-color': '#ffffff', 'text-halo-width': 1.5 } },
    ],
  },
});

// the map itself, whole, as bytes; with an address as its source, a page asks for what it shows
const counties = new VectorTileLayer({ id: 'counties', source: await (await fetch('counties.pmtiles')).blob() });
map.once('load', () => map.addLayer(counties, 'labels')); // above the ground, below the names
counties.ready().then(() => map.addControl(new AttributionControl({ customAttribution: counties.attribution })));

// an invented rate of each county in 120 months: given once, and then a time changes a few bytes of each county in view
const places = await (await fetch('counties.json')).json();
const ids = Object.keys(places);
const stops = [[0.16, 0.18, 0.45], [0.2, 0.5, 0.6], [0.65, 0.8, 0.6], [0.98, 0.86, 0.42], [0.98, 0.86, 0.42]]; // sRGB
const shade = (r) => stops[Math.floor(3 * r)].map((low, c) => low + ((3 * r) % 1) * (stops[Math.floor(3 * r) + 1][c] - low));
const rate = ([lng, lat], t) => 0.5 + 0.4 * Math.sin(lng / 7 - t / 6) * Math.cos(lat / 4 + t / 19) + 0.1 * Math.sin(997 * lng);
const colors = Array.from({ length: 120 }, (_, t) => ids.map((id) => [...shade(rate(places[id], t)), 1]));
counties.setTimes({ ids, colors });

let [hovered, kept] = [null, null];
const marker = new Marker({ color: '#c8102e' });
counties.on('hover', ({ feature }) => (hovered = feature?.id));
counties.on('click', ({ feature, lngLat }) => {
  kept = feature?.id;
  if (kept) marker.setLngLat(lngLat).addTo(map);
  else marker.remove();
});
let playing = !matchMedia('(prefers-reduced-motion: reduce)').matches;
slider.addEventListener('pointerdown', () => (playing = false));
requestAnimationFrame(function step(now) {
  if (playing) slider.value = (now / 250) % 119;
  const [time, id] = [Number(slider.value), hovered ?? kept];
  counties.setTime(time);
  month.textContent = new Date(2015, Math.round(time)).toLocaleDateString('en', { month: 'long', year: 'numeric' });
  name.value = id ? `${id}: ${(100 * rate(places[id], time)).toFixed(0)} %` : 'Point at a county, click to keep it';
  requestAnimationFrame(step);
});
