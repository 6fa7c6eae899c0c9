import { expect } from 'vitest';
import { VextureError } from '../src/errors.js';

/**
 * Expect a refusal in one line that names the field at fault.
 *
 * @param {Promise<unknown>} reading
 * @param {string | RegExp} field
 * @param {string | RegExp} [message]
 */
export async function expectRefusal(reading, field, message = /./) {
  const error = await reading.then(
    () => null,
    (reason) => reason,
  );
  expect(error).toBeInstanceOf(VextureError);
  expect(error.field).toMatch(typeof field === 'string' ? new RegExp(`^${field.replace(/[[\].*]/g, '\\$&')}$`) : field);
  expect(error.message).toMatch(message);
  expect(error.message).not.toMatch(/[\p{Cc}]/u);
  expect(error.message.length).toBeLessThan(400);
}
