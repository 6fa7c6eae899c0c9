/**
 * The data embedded in the page.
 *
 * @typedef {object} Facts
 * @property {string | null} [time] ISO 8601
 * @property {string} [label] short text for people
 * @property {boolean} [dry] nothing is under water
 * @property {number | null} [deepest] metres
 *
 * @typedef {object} Manifest
 * @property {string} name
 * @property {string} texture URL
 * @property {Facts} [facts]
 * @property {{depth?: string}} [views] depth: 8-bit gray PNG over the box, 255 is the deepest
 * @property {string | null} [note]
 *
 * @typedef {object} FrameFacts
 * @property {[number, number, number, number]} box where the frame is in the unit square
 * @property {[number, number, number, number, number, number]} to_source from there to the reference system
 * @property {[number, number]} metres width and height on the ground
 * @property {string} crs
 * @property {boolean} geographic
 *
 * @typedef {object} ReliefFacts
 * @property {number} columns
 * @property {number} rows northernmost first
 * @property {number} unit metres
 * @property {string} heights data: URI of little-endian int16
 * @property {boolean} invented
 *
 * @typedef {object} Flood
 * @property {string} title
 * @property {(string | Manifest)[]} steps names on the server, or all of each
 * @property {string} prefix of the names of later steps
 * @property {FrameFacts} frame
 * @property {string | null} ground URL of a picture of the box
 * @property {ReliefFacts} relief
 * @property {string | null} fold URL
 * @property {{place: [number, number], seaward: [number, number]} | null} shore in the unit square
 * @property {string[]} notes
 *
 * @typedef {{server?: string, flood: Flood}} Scene
 */

/** @returns {Scene} */
export function readScene() {
  return JSON.parse(document.getElementById('vexture-scene')?.textContent ?? '{}');
}
