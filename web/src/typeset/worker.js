// The worker of texts. It listens at once: HarfBuzz is loaded by a top-level await, and messages to a worker that does not
// listen yet are lost. The first message says where HarfBuzz is.
import { line } from '../errors.js';

/** @import { Typesetter } from './typesetter.js' */

const scope = /** @type {Worker} */ (/** @type {unknown} */ (globalThis)); // what it has of a worker's side is the same

/** @type {Promise<Typesetter> | undefined} */
let starting;

function startOnce() {
  const promise = start();
  promise.catch(() => setTimeout(() => (starting = undefined), PATIENCE)); // the network may be back then
  return promise;
}

/** Time in ms after which HarfBuzz is loaded again if it could not be. */
const PATIENCE = 10_000;

/** Address or content of HarfBuzz; undefined: it knows by itself. @type {string | BufferSource | undefined} */
let harfbuzz;

async function start() {
  const stop = harfbuzz === undefined ? () => {} : replaceHarfBuzz(harfbuzz);
  try {
    return new (await import('./typesetter.js')).Typesetter();
  } finally {
    stop();
  }
}

/**
 * Answer the request for HarfBuzz by something else: the module harfbuzzjs has no option for its address, and nothing else
 * is requested while it starts.
 *
 * @param {string | BufferSource} source
 * @returns {() => void} ends it
 */
function replaceHarfBuzz(source) {
  const { fetch } = globalThis;
  globalThis.fetch = async (input, options) => {
    if (!/\.wasm($|[?#])/.test(String(input instanceof Request ? input.url : input))) return fetch(input, options);
    return typeof source === 'string' ? fetch(source, options) : new Response(source, { headers: { 'Content-Type': 'application/wasm' } });
  };
  return () => {
    globalThis.fetch = fetch;
  };
}

scope.onmessage = async (/** @type {MessageEvent} */ { data }) => {
  try {
    if (data && 'harfbuzz' in data) harfbuzz = data.harfbuzz;
    starting ??= startOnce();
    const answer = await (await starting).answer(data);
    if (answer) scope.postMessage(answer.reply, answer.transfer);
  } catch (error) {
    const about = line(error);
    const message = `texts cannot be set (${about}); check that the page may load the module harfbuzzjs and its harfbuzz.wasm`;
    if (data?.id !== undefined) scope.postMessage({ id: data.id, error: { message, field: 'worker' } });
  }
};
