// Delays, exponential back-off and time limits.
import { VextureError } from './errors.js';

const FIRST = 500;
const LONGEST = 30000;

/** Time limit for a small file, in milliseconds. */
const TIME_LIMIT = 30000;

/**
 * Milliseconds to wait after consecutive failures: doubled after each, half a minute at most. Randomized, so that the
 * clients of a restarted server do not all ask at once.
 *
 * @param {number} failures
 */
export function backOff(failures) {
  const most = failures > 0 ? Math.min(LONGEST, FIRST * 2 ** (failures - 1)) : 0;
  return most * (0.5 + 0.5 * Math.random());
}

/**
 * @param {number} milliseconds
 * @param {AbortSignal} signal ends it early
 * @returns {Promise<void>}
 */
export function sleep(milliseconds, signal) {
  return new Promise((resolve) => {
    const done = () => {
      clearTimeout(timer);
      signal.removeEventListener('abort', done);
      resolve();
    };
    const timer = setTimeout(done, milliseconds);
    signal.addEventListener('abort', done);
    if (signal.aborted) done();
  });
}

/**
 * A signal that also aborts after the time limit.
 *
 * @param {AbortSignal} signal
 * @param {string} url that it is for
 * @returns {{ signal: AbortSignal, done: () => void }}
 */
export function withTimeLimit(signal, url) {
  const controller = new AbortController();
  const abort = () => controller.abort(signal.reason);
  const timer = setTimeout(
    () => controller.abort(new VextureError(`${url}: no answer in ${TIME_LIMIT / 1000} s; check the server`, 'url')),
    TIME_LIMIT,
  );
  signal.addEventListener('abort', abort);
  if (signal.aborted) abort();
  return {
    signal: controller.signal,
    done() {
      clearTimeout(timer);
      signal.removeEventListener('abort', abort);
    },
  };
}
