// The worker of texts. It listens at once: HarfBuzz is loaded by a top-level await, and messages to a worker that does not
// listen yet are lost.
import { line } from '../errors.js';

/** @import { Typesetter } from './typesetter.js' */

const scope = /** @type {Worker} */ (/** @type {unknown} */ (globalThis)); // what it has of a worker's side is the same

/** @type {Promise<Typesetter> | undefined} */
let starting;

const start = async () => new (await import('./typesetter.js')).Typesetter();

scope.onmessage = async (/** @type {MessageEvent} */ { data }) => {
  try {
    starting ??= start();
    const answer = await (await starting).answer(data);
    if (answer) scope.postMessage(answer.reply, answer.transfer);
  } catch (error) {
    const about = line(error);
    const message = `texts cannot be set (${about}); check that the page may load the module harfbuzzjs and its harfbuzz.wasm`;
    if (data?.id !== undefined) scope.postMessage({ id: data.id, error: { message, field: 'worker' } });
  }
};
starting = start();
starting.catch(() => {
  starting = undefined; // the network may be back at the next message
});
