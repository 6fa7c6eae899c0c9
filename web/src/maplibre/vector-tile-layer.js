import { VextureError, line } from '../errors.js';
import { FeatureColors } from '../tiles/feature-colors.js';
import { LEAD, TILE_SIZE, mercator } from '../tiles/grid.js';
import { checkFunction } from '../tiles/options.js';
import { Pyramid } from '../tiles/pyramid.js';
import { TilePainter } from './painter.js';

/**
 * @typedef {import('maplibre-gl').Map} MapLibreMap
 * @typedef {import('../tiles/feature-colors.js').FeatureId} FeatureId
 * @typedef {import('../tiles/feature-colors.js').FeaturePaints} FeaturePaints
 * @typedef {import('../tiles/feature-colors.js').PaintFunction} PaintFunction
 * @typedef {import('../tiles/feature-colors.js').TimeTable} TimeTable
 * @typedef {import('../tiles/pyramid.js').Feature} Feature
 *
 * @typedef {object} VectorTileLayerOptions Data of a layer, and limits of its memory and requests.
 * @property {string} id of the layer
 * @property {string | URL | import('../tiles/source.js').TileArchive | import('../tiles/source.js').TileSource} source address of a
 *   `.pmtiles` or a TileJSON, the bytes of a `.pmtiles`, or a source of your own
 * @property {number} [opacity] of the whole layer, 0..1
 * @property {number} [budget] bytes of tiles in memory
 * @property {number} [most] number of simultaneous requests
 * @property {number} [retries] number of retries of a failed request
 * @property {number} [pause] milliseconds before the first retry
 *
 * @typedef {object} FeatureEvent Argument of listeners.
 * @property {Feature | null} feature under the pointer
 * @property {{ lng: number, lat: number }} lngLat the place, in degrees
 * @property {{ x: number, y: number }} point in CSS pixels
 *
 * @typedef {{ hover: FeatureEvent, click: FeatureEvent, error: { error: unknown, tile?: import('../tiles/grid.js').TileId } }} LayerEvents
 *   What listeners of each event get.
 */

/** Events of a layer. */
const EVENTS = ['hover', 'click', 'error'];

/** Oldest version of MapLibre that provides the tiles that cover a view. */
const OLDEST = '5.7';

/** CSS pixels from the pointer to the nearest place of the map, above which nothing is under the pointer. */
const BESIDE = 2;

/**
 * A map of `vexture tiles` as a layer of MapLibre, flat and on the globe: `map.addLayer(layer, beforeId)`.
 */
export class VectorTileLayer {
  /** A custom layer, to MapLibre. @type {'custom'} */
  type = 'custom';
  /** It lies on the ground. @type {'2d'} */
  renderingMode = '2d';
  /** @type {MapLibreMap | null} */
  #map = null;
  /** @type {TilePainter | null} */
  #painter = null;
  /** @type {Pyramid} */
  #pyramid;
  #options;
  #opacity = 1;
  /** @type {Map<string, Set<(event: any) => void>>} */
  #listeners = new Map();
  /** The event by which a feature came under the pointer. @type {FeatureEvent | null} */
  #hovered = null;
  /** The layers of the map when it was drawn last, from below. @type {string[]} */
  #order = [];
  /** Whether the listeners know of the map's terrain. */
  #isTold = false;

  /**
   * @param {VectorTileLayerOptions} options
   * @throws {VextureError} if an option is invalid
   */
  constructor(options) {
    const { id, opacity = 1 } = options ?? {};
    if (typeof id !== 'string' || !id) throw new VextureError(`the layer's id is ${line(id)}; give a text`, 'id');
    /** Its name in MapLibre. @type {string} */
    this.id = id;
    this.#options = options;
    this.#pyramid = this.#open(new FeatureColors());
    this.setOpacity(opacity);
  }

  /** @param {FeatureColors} colors */
  #open(colors) {
    return new Pyramid({
      ...this.#options,
      onChange: () => this.#map?.triggerRepaint(),
      onDrop: (loaded) => this.#painter?.drop(loaded),
      onError: (error, tile) => this.#emit('error', { error, tile }),
    }, colors);
  }

  /** Wait for the pyramid's metadata. @returns {Promise<void>} */
  async ready() {
    await this.#pyramid.ready;
  }

  /** Attribution of the data, available after `ready()`, to be shown beside the map. */
  get attribution() {
    return this.#pyramid.client?.source.attribution ?? '';
  }

  /** Statistics of what the layer holds and shows. */
  get stats() {
    const { client, shown } = this.#pyramid;
    const tiles = [...(client?.tiles ?? [])];
    return {
      tiles: tiles.length,
      bytes: client?.bytes ?? 0,
      running: client?.running ?? 0,
      held: this.#painter?.held ?? 0,
      rowsSent: this.#painter?.sent ?? 0,
      shown: shown.map(({ quad, loaded }) => ({ quad, tile: loaded.tile })),
    };
  }

  /**
   * Set colours by the features' ids. A table is merged with earlier tables, and overrides the colours of `setTimes`; a
   * function is called for features that neither colours; null restores the colours of the tiles.
   *
   * @param {FeaturePaints | PaintFunction | null} paints
   * @throws {VextureError} if a colour is invalid
   */
  setPaint(paints) {
    this.#pyramid.colors.setPaint(paints);
    this.#map?.triggerRepaint();
  }

  /**
   * Show only some features; others are neither visible nor picked.
   *
   * @param {Iterable<FeatureId> | ((id: string) => boolean) | null} shown ids, or a predicate; null shows all
   */
  setFilter(shown) {
    this.#pyramid.colors.setFilter(shown);
    this.#map?.triggerRepaint();
  }

  /**
   * Set the colours of features at each step of time; null removes them. A table of `setPaint` has priority over them, a function has not.
   *
   * @param {TimeTable | null} table
   * @throws {VextureError} if the number of colours of a step differs from that of the ids, or a colour is invalid
   */
  setTimes(table) {
    this.#pyramid.colors.setTimes(table);
    this.#map?.triggerRepaint();
  }

  /**
   * Show the colours of `setTimes` at a time.
   *
   * @param {number} time in steps; between two steps colours are mixed
   */
  setTime(time) {
    this.#pyramid.colors.setTime(time);
    this.#map?.triggerRepaint();
  }

  /**
   * Set the opacity, with which the map below shows through.
   *
   * @param {number} opacity of all of it, 0..1
   */
  setOpacity(opacity) {
    if (typeof opacity !== 'number' || !(opacity >= 0 && opacity <= 1)) throw new VextureError(`the opacity is ${line(opacity)}; give 0 to 1`, 'opacity');
    this.#opacity = opacity;
    this.#map?.triggerRepaint();
  }

  /**
   * Find the feature at a place; null if there is none, or the layer is hidden.
   *
   * @param {{ lng: number, lat: number } | [number, number]} place
   * @returns {Feature | null}
   * @throws {VextureError} if the place is invalid
   */
  featureAt(place) {
    const map = this.#map;
    const isHidden = map?.getLayer(this.id)?.isHidden(map.getZoom());
    const feature = this.#pyramid.featureAt(place);
    return isHidden ? null : feature;
  }

  /** Retry loading tiles or metadata that could not be loaded. */
  retry() {
    this.#pyramid.retry();
  }

  /**
   * Listen to an event.
   *
   * @template {keyof LayerEvents} Type
   * @param {Type} type `hover`: the pointer has moved to another feature, or to none; `click`; `error`: something cannot be
   *   loaded, or one of your functions has thrown an error
   * @param {(event: LayerEvents[Type]) => void} listener
   * @throws {VextureError} if there is no such event, or the listener is not a function
   */
  on(type, listener) {
    if (!EVENTS.includes(type)) throw new VextureError(`the event is ${line(type)}; give one of ${EVENTS.join(', ')}`, 'event');
    checkFunction(listener, 'the listener');
    const known = this.#listeners.get(type) ?? new Set();
    this.#listeners.set(type, known.add(listener));
    return this;
  }

  /**
   * Stop listening.
   *
   * @param {keyof LayerEvents} type
   * @param {(event: any) => void} listener
   */
  off(type, listener) {
    this.#listeners.get(type)?.delete(listener);
    return this;
  }

  /**
   * @template {keyof LayerEvents} Type
   * @param {Type} type
   * @param {LayerEvents[Type]} event
   */
  #emit(type, event) {
    const listeners = this.#listeners.get(type);
    if (type === 'error' && !listeners?.size) console.error(/** @type {any} */ (event).error);
    for (const listener of listeners ?? []) {
      try {
        listener(event);
      } catch (error) {
        reportError(error); // the others, and MapLibre's own, hear of it all the same
      }
    }
  }

  /**
   * @param {{ lng: number, lat: number }} place
   * @param {{ x: number, y: number }} point
   */
  #under(place, point) {
    const seen = this.#map?.project([place.lng, place.lat]);
    const isBeside = !seen || Math.hypot(seen.x - point.x, seen.y - point.y) > BESIDE; // of a globe
    return isBeside ? null : this.featureAt(place);
  }

  #pointed = (/** @type {import('maplibre-gl').MapMouseEvent} */ { lngLat, point }) => {
    if (!this.#listeners.get('hover')?.size) return;
    const feature = this.#under(lngLat, point);
    if (feature?.id === this.#hovered?.feature?.id) return;
    const event = { feature, lngLat, point };
    this.#hovered = feature && event;
    this.#emit('hover', event);
  };

  #left = (/** @type {import('maplibre-gl').MapMouseEvent} */ { lngLat, point }) => {
    this.#leave({ feature: null, lngLat, point });
  };

  /** @param {FeatureEvent} event */
  #leave(event) {
    if (!this.#hovered) return;
    this.#hovered = null;
    this.#emit('hover', event);
  }

  #clicked = (/** @type {import('maplibre-gl').MapMouseEvent} */ { lngLat, point }) => {
    if (this.#listeners.get('click')?.size) this.#emit('click', { feature: this.#under(lngLat, point), lngLat, point });
  };

  /** What it hears of its map. @type {[any, (event: any) => void][]} */
  get #heard() {
    return [['mousemove', this.#pointed], ['mouseout', this.#left], ['click', this.#clicked], ['style.load', this.#restyled], ['remove', this.#end]];
  }

  /**
   * Another style is there, or the same one after a lost context. MapLibre drops custom layers with the old one, or leaves them
   * below all that is new: this one comes back by itself, where it was, with its tiles.
   */
  #restyled = () => {
    const map = this.#map;
    if (!map) return; // removed by who has heard of it before
    const at = this.#order.indexOf(this.id);
    const above = this.#order.slice(at + 1);
    /** @type {(id: string) => unknown} */
    const layerOf = (id) => /** @type {any} */ (map.getLayer(id))?.implementation;
    const other = above.map(layerOf).find((one) => one instanceof VectorTileLayer);
    if (other) other.#restyled(); // if it has been left below, it is at its place first
    const order = map.getLayersOrder().filter((id) => id !== this.id);
    const below = this.#order.slice(0, at).findLast((id) => order.includes(id));
    const next = above.find((id) => order.includes(id)) ?? (above.length && below ? order[order.indexOf(below) + 1] : undefined);
    if (!map.getLayer(this.id)) map.addLayer(this, next);
    else if (layerOf(this.id) === this) map.moveLayer(this.id, next);
    else this.#end(); // the style has another one of this name
  };

  /**
   * Called by MapLibre. A layer that was removed opens its pyramid again, with the colours that it had.
   *
   * @param {MapLibreMap} map
   * @param {WebGL2RenderingContext} gl
   */
  onAdd(map, gl) {
    const isOld = typeof map.coveringTiles !== 'function' || !(gl instanceof WebGL2RenderingContext);
    if (isOld || (this.#map && this.#map !== map)) {
      map.removeLayer(this.id);
      throw new VextureError(isOld ? `maplibre-gl ${map.version} is too old; use version ${OLDEST} or newer`
        : `the layer "${this.id}" is on another map; make another VectorTileLayer for this one`, 'map');
    }
    if (this.#pyramid.isClosed) this.#pyramid = this.#open(this.#pyramid.colors);
    if (!this.#map) for (const [type, listener] of this.#heard) map.on(type, listener);
    this.#map = map;
    this.#painter ??= new TilePainter(gl); // it was not removed where another style has dropped it
    this.#order = map.getLayersOrder();
  }

  /**
   * Called by MapLibre.
   *
   * @param {MapLibreMap} map
   */
  onRemove(map) {
    if (map !== this.#map) return; // it has been refused
    if (this.#hovered) this.#leave({ ...this.#hovered, feature: null });
    if (this.#painter?.isLost) this.#painter = null;
    else this.#end();
  }

  /** Its map has no use for it any more. */
  #end = () => {
    for (const [type, listener] of this.#heard) this.#map?.off(type, listener);
    this.#pyramid.dispose();
    this.#painter?.dispose();
    this.#painter = null;
    this.#map = null;
  };

  /**
   * Called by MapLibre for each frame.
   *
   * @param {WebGL2RenderingContext} gl
   * @param {import('maplibre-gl').CustomRenderMethodInput} render
   */
  render(gl, render) {
    const { client } = this.#pyramid;
    const painter = this.#painter;
    if (!client || !painter || !this.#map) return;
    this.#order = this.#map.getLayersOrder();
    this.#warnOfTerrain(this.#map);
    const shown = this.#pyramid.update(this.#quads(this.#map), (loaded, rows) => painter.send(loaded, rows));
    const { transform } = /** @type {any} */ (this.#map);
    // versions before 6 have it there
    const getProjectionData = render.getProjectionData ?? ((/** @type {any} */ given) => transform.getProjectionData(given));
    painter.draw(shown, { ...render, getProjectionData }, client.source.margin, this.#opacity);
  }

  /** MapLibre does not lay custom layers over a terrain. @param {MapLibreMap} map */
  #warnOfTerrain(map) {
    const isTold = Boolean(map.getTerrain());
    if (isTold && !this.#isTold) {
      const message = `the layer "${this.id}" lies at sea level, not on the map's terrain; take that away by map.setTerrain(null)`;
      this.#emit('error', { error: new VextureError(message, 'terrain') });
    }
    this.#isTold = isTold;
  }

  /** @param {MapLibreMap} map @returns {import('../tiles/choose.js').Quad[]} */
  #quads(map) {
    const { lng, lat } = map.getCenter();
    const [x, y] = mercator(lng, lat);
    return map.coveringTiles({ tileSize: TILE_SIZE * 2 ** -LEAD }).map(({ wrap, canonical }) => {
      const side = 2 ** -canonical.z;
      const distance = Math.hypot((canonical.x + 0.5) * side - x, (canonical.y + 0.5) * side - y);
      return { z: canonical.z, x: canonical.x, y: canonical.y, wrap, distance };
    });
  }
}
