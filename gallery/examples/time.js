import { AttributionControl, Map, Marker } from 'maplibre-gl';
import { VectorTileLayer } from 'vexture/maplibre';
import { addPanel, moves } from './helpers.js';

document.body.insertAdjacentHTML('beforeend', '<div id="map" style="height: 100%"></div>');

const cities = { Seattle: [-122.33, 47.61], 'Los Angeles': [-118.24, 34.05], Denver: [-104.99, 39.74], Houston: [-95.37, 29.76],
  Chicago: [-87.63, 41.88], Miami: [-80.19, 25.76], 'New York': [-74.01, 40.71], Anchorage: [-149.9, 61.22] };
const features = Object.entries(cities).map(([label, coordinates]) =>
  ({ type: 'Feature', properties: { label }, geometry: { type: 'Point', coordinates } }));
const map = new Map({
  container: 'map', bounds: [[-125, 24], [-66.5, 49.5]], fitBoundsOptions: { padding: { top: 30, left: 15, right: 15, bottom: 170 } },
  maxZoom: 14, attributionControl: false,
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
counties.ready().then(() => map.addControl(new AttributionControl({ customAttribution: counties.attribution }), 'top-right'));

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

const panel = addPanel('A rate that is invented');
const monthOf = (t) => new Date(2015, Math.round(t)).toLocaleDateString('en', { month: 'short', year: 'numeric' });
const time = panel.slider('Month', { min: 0, max: 119, value: 0, show: monthOf });
const plays = panel.toggle('Play', moves);
panel.slider('Tilt', { min: 0, max: 60, value: 0, step: 1, unit: '°' }, (pitch) => map.setPitch(pitch));
panel.legend([0, 1, 2, 3].map((k) => [`rgb(${stops[k].map((part) => 255 * part)})`, `${Math.round((100 * k) / 3)} %`]));
const line = panel.text();
let [last, shown] = [0, 0];
requestAnimationFrame(function step(now) {
  if (time.value !== shown) plays.value = false; // the visitor moves it
  if (plays.value) time.value = (time.value + Math.min(now - last, 100) / 250) % 119;
  [last, shown] = [now, time.value];
  counties.setTime(shown);
  const id = hovered ?? kept;
  line.textContent = id ? `${id}: ${(100 * rate(places[id], shown)).toFixed(0)} %` : 'Point at a county, click to keep it';
  requestAnimationFrame(step);
});
