// Markup for a page that requires Trusted Types: it is parsed under a policy of this package.
import { VextureError } from '../errors.js';

/** @typedef {{ createHTML: (text: string) => string }} Policy as text, which is what the types of the DOM expect */

/** Name of the policy, which a page may have to allow. */
const NAME = 'vexture';

/** @type {Policy | null | undefined} null if the page has no such types, or does not allow the policy */
let policy;

/** @returns {Policy | null} */
function ownPolicy() {
  const { trustedTypes } = /** @type {{ trustedTypes?: any }} */ (globalThis);
  try {
    return trustedTypes?.createPolicy(NAME, { createHTML: (/** @type {string} */ text) => text }) ?? null;
  } catch { // the page allows others only
    return null;
  }
}

/**
 * Give markup to a function of the page that may require it to be trusted. It is for documents in which nothing runs.
 *
 * @template Result
 * @param {string} text
 * @param {(text: string) => Result} use
 * @returns {Result}
 * @throws {VextureError} if the page does not allow the policy
 */
export function withTrust(text, use) {
  policy ??= ownPolicy();
  try {
    return use(policy ? policy.createHTML(text) : text);
  } catch (error) {
    if (!(error instanceof TypeError && /Trusted/.test(error.message))) throw error;
    throw new VextureError(
      `the page requires Trusted Types; allow the policy '${NAME}' in its Content-Security-Policy (trusted-types ${NAME})`,
      'policy', { cause: error },
    );
  }
}
