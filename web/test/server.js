// A real server for tests, whose answers are in the test's hands.
import { createServer } from 'node:http';

/**
 * @callback Answer
 * @param {import('node:http').IncomingMessage} request
 * @param {import('node:http').ServerResponse} response
 * @returns {void}
 */

/**
 * Serve on a free port of this machine; answers are looked up by path at each request.
 *
 * @param {Record<string, Answer | Uint8Array | string>} answers
 * @param {number} [port]
 */
export async function serve(answers, port = 0) {
  /** @type {{ path: string, status: number, headers: import('node:http').IncomingHttpHeaders }[]} */
  const log = [];
  const server = createServer((request, response) => {
    const path = request.url ?? '';
    response.on('close', () => log.push({ path, status: response.statusCode, headers: request.headers }));
    const answer = answers[path];
    if (typeof answer === 'function') answer(request, response);
    else if (answer === undefined) response.writeHead(404).end();
    else response.end(answer);
  });
  await new Promise((resolve) => server.listen(port, '127.0.0.1', () => resolve(undefined)));
  const address = /** @type {import('node:net').AddressInfo} */ (server.address());
  return {
    answers,
    log,
    port: address.port,
    url: `http://127.0.0.1:${address.port}`,
    async close() {
      server.closeAllConnections();
      await new Promise((resolve) => server.close(resolve));
    },
  };
}

/** @typedef {Awaited<ReturnType<typeof serve>>} Server */
