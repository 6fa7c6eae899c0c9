/**
 * The data embedded in the page.
 *
 * @typedef {object} Facts
 * @property {string | null} [time] ISO 8601
 * @property {string} [label] short text for people
 * @property {boolean} [dry] nothing is under water
 * @property {number | null} [deepest] metres
 * @property {number} [area] square metres under water
 * @property {{lowest: number, unit: number}} [level] metres, of the picture of levels
 * @property {{scale: number, step: number} | null} [depth] of the picture of depths; null: they are not known
 * @property {[number, number | null][] | null} [ranges] metres of the classes of depth of data that hold them in place of
 *   depths
 * @property {{unit: number} | null} [hazard] of the picture of the hazard
 *
 * @typedef {object} Manifest
 * @property {string} name
 * @property {string} texture URL
 * @property {Facts} [facts]
 * @property {{depth?: string, ranks?: string, level?: string, classes?: string, hazard?: string}} [views] depth and ranks:
 *   gray PNGs over the box (depths.js); level and hazard: gray PNGs on the grid of the relief (levels.js, hazard.js);
 *   classes: planar map of the classes of depth
 * @property {string | null} [note]
 *
 * @typedef {object} FrameFacts
 * @property {[number, number, number, number]} box where the frame is in the unit square
 * @property {[number, number, number, number, number, number]} to_source from there to the reference system
 * @property {[number, number]} metres width and height on the ground
 * @property {string} crs
 * @property {boolean} geographic
 * @property {{columns: number, rows: number, places: number[]} | null} geodetic longitudes and latitudes on a grid over the
 *   box, northernmost row first, from corner to corner
 *
 * @typedef {object} ReliefFacts
 * @property {number} columns
 * @property {number} rows northernmost first
 * @property {number} unit metres
 * @property {string} heights data: URI of little-endian int16
 * @property {boolean} invented
 * @property {number} still metres of the still water above the zero of the heights' source
 *
 * @typedef {object} Credits
 * @property {string} title
 * @property {string} source
 * @property {string} institution
 * @property {string} references
 * @property {string} licence
 * @property {string} comment
 * @property {boolean} synthetic
 *
 * @typedef {object} Flood
 * @property {string} title
 * @property {Credits} credits
 * @property {{from: number, to?: number, color: string}[]} depths metres from which the classes of the map of depths begin,
 *   and at which the last one ends, if it does
 * @property {string[]} arrivals colours of as many times of arrival, the first to come first
 * @property {{from: number, color: string, text: string}[]} hazards ratings from which the classes of hazard begin
 * @property {(string | Manifest)[]} steps names on the server, or all of each
 * @property {string} prefix of the names of later steps
 * @property {FrameFacts} frame
 * @property {string | null} ground URL of a picture of the box
 * @property {ReliefFacts} relief
 * @property {string | null} fold URL
 * @property {string | null} openness URL of an 8-bit gray PNG over the box: 255 where waves meet a shore of open water
 * @property {{name: string, kind: 'over' | 'far' | 'near' | 'eye', place: [number, number], toward: [number, number],
 *   reach: number, above: number}[]} views places and directions in the unit square, metres
 * @property {string[]} notes
 *
 * @typedef {{server?: string, flood: Flood}} Scene
 */

/** @returns {Scene} */
export function readScene() {
  return JSON.parse(document.getElementById('vexture-scene')?.textContent ?? '{}');
}
