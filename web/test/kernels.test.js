// Calls of kernels in WebAssembly.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { expect, it } from 'vitest';
import { describeWithKernels } from './built-kernels.js';
import { Kernels } from '../src/convert/kernels.js';

const FILE = new URL('../kernels/silhouettes.wasm', import.meta.url);

/** @param {[number, number][]} corners */
const polygon = (corners) =>
  Float64Array.from(
    corners.flatMap(([x, y], place) => {
      const [toX, toY] = corners[(place + 1) % corners.length];
      return [0, 1 / 3, 2 / 3, 1].flatMap((t) =>
        t === 1 ? [toX, toY] : t === 0 ? [x, y] : [x + t * (toX - x), y + t * (toY - y)],
      );
    }),
  );

const TRIANGLE = polygon([
  [0.1, 0.1],
  [0.9, 0.1],
  [0.5, 0.9],
]);

/** @param {Kernels} kernels */
const limits = ({ constants }) => ({
  capacity: constants.CAPACITY,
  tolerance: constants.TOLERANCE,
  near: constants.NEAR,
  least_depth: 1,
  max_depth: constants.MAX_DEPTH,
  most_quads: constants.MOST_QUADS,
});

/** @param {Kernels} kernels @param {ArrayLike<number>} cubics @param {number} contours */
const silhouette = (kernels, cubics, contours = 1) => {
  const lengths = Array(contours).fill(cubics.length / 8 / contours),
    zeros = Array(contours).fill(0);
  return kernels.call('silhouette_texels', [
    cubics,
    lengths,
    zeros,
    [0],
    limits(kernels),
    0,
    kernels.constants.ENDLESS,
  ]);
};

describeWithKernels('kernels', () => {
  it('are loaded from the package, from bytes, and from a response of any type', async () => {
    const kernels = await Kernels.load(FILE);
    expect(kernels.digest).toMatch(/^[0-9a-f]{12}$/);
    expect(Object.keys(kernels.entries)).toContain('silhouette_texels');
    const bytes = readFileSync(FILE);
    const responses = ['application/wasm', 'text/plain'].map(
      (type) => new Response(bytes, { headers: { 'Content-Type': type } }),
    );
    for (const source of [
      bytes,
      new Uint8Array(bytes).buffer,
      ...responses,
      Promise.resolve(bytes),
      String(FILE),
    ]) {
      expect((await Kernels.load(source)).digest).toBe(kernels.digest);
    }
  });

  it('are loaded from a server, and a missing file is named', async () => {
    const server = createServer((request, response) => {
      response.writeHead(request.url === '/kernels.wasm' ? 200 : 404, { 'Content-Type': 'application/wasm' });
      response.end(request.url === '/kernels.wasm' ? readFileSync(FILE) : '');
    });
    await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(null)));
    const { port } = /** @type {import('node:net').AddressInfo} */ (server.address());
    const home = `http://127.0.0.1:${port}`;
    expect((await Kernels.load(`${home}/kernels.wasm`)).entries).toHaveProperty('silhouette_texels');
    await expect(Kernels.load(`${home}/other.wasm`)).rejects.toThrow(/other\.wasm: HTTP 404/);
    await expect(Kernels.load(new URL('file:///no/such.wasm'))).rejects.toThrow(/no such file.*build_wasm/i);
    server.close();
  });

  it('refuse what is no module, and modules of others', async () => {
    await expect(Kernels.load(new TextEncoder().encode('<!doctype html>'))).rejects.toThrow(
      /cannot be compiled .*; give a module of the package/,
    );
    const empty = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);
    await expect(Kernels.load(empty)).rejects.toThrow(
      'the WebAssembly holds no kernels of vexture; give a module of the package',
    );
  });

  it('say which policy forbids them', async () => {
    const { compile } = WebAssembly;
    WebAssembly.compile = async () => {
      throw new WebAssembly.CompileError("Refused to compile WebAssembly module because 'unsafe-eval' is not allowed");
    };
    await expect(Kernels.load(readFileSync(FILE)).finally(() => (WebAssembly.compile = compile))).rejects.toThrow(
      "allow it by the policy script-src 'wasm-unsafe-eval'",
    );
  });

  it('return copies by name, the same in every call', async () => {
    const kernels = await Kernels.load(FILE);
    const first = silhouette(kernels, TRIANGLE),
      kept = first.texels.slice();
    const star = polygon(
      Array.from({ length: 60 }, (_, k) => [0.5 + 0.4 * Math.sin(k * 2.5), 0.5 + 0.4 * Math.cos(k * 2.5)]),
    );
    expect(silhouette(kernels, star).quads).toBeGreaterThan(first.quads);
    expect(first).toMatchObject({ outside: 0, unresolved: 0, quads: 1 });
    expect(first.texels).toBeInstanceOf(Uint32Array);
    expect(first.texels).toEqual(kept);
    expect(silhouette(kernels, [...TRIANGLE]).texels).toEqual(kept);
  });

  it('give memory back after a large drawing, and return the same as before', async () => {
    const kernels = await Kernels.load(FILE),
      before = silhouette(kernels, TRIANGLE).texels;
    const count = 60_000;
    const ring = polygon(
      Array.from({ length: count }, (_, k) => {
        const turn = (2 * Math.PI * k) / count;
        const far = 0.4 + 0.05 * Math.sin(900 * turn);
        return [0.5 + far * Math.cos(turn), 0.5 + far * Math.sin(turn)];
      }),
    );
    const small = kernels.bytes;
    const once = silhouette(kernels, ring).texels;
    expect(once.length).toBeGreaterThan(10_000);
    expect(kernels.bytes).toBeLessThanOrEqual(small);
    expect(Buffer.compare(Buffer.from(once.buffer), Buffer.from(silhouette(kernels, ring).texels.buffer))).toBe(0);
    expect(silhouette(kernels, TRIANGLE).texels).toEqual(before);
  });

  it('name the argument that is wrong', async () => {
    const kernels = await Kernels.load(FILE),
      zero = [0];
    const call =
      (/** @type {unknown[]} */ ...given) =>
      () =>
        kernels.call('silhouette_texels', given);
    expect(() => kernels.call('texels', [])).toThrow(/^no kernel is named "texels"; there are silhouette_texels/);
    expect(call(TRIANGLE)).toThrow('silhouette_texels has 7 arguments, not 1');
    expect(call(7, [3], zero, zero, limits(kernels), 0, 1)).toThrow(
      'silhouette_texels: cubics is 7; it must be an array of <f8',
    );
    expect(call(TRIANGLE.slice(1), [3], zero, zero, limits(kernels), 0, 1)).toThrow(
      /cubics is .* an array of the shape any x 4 x 2/,
    );
    expect(call(TRIANGLE, [3], zero, zero, null, 0, 1)).toThrow(
      /bounds is null; it must be an object of capacity, tolerance/,
    );
    expect(call(TRIANGLE, [3], zero, zero, { ...limits(kernels), capacity: 0.5 }, 0, 1)).toThrow(
      /bounds\.capacity is 0\.5; it must be a whole/,
    );
    expect(call(TRIANGLE, [3], zero, zero, limits(kernels), '0', 1)).toThrow(/first is "0"; it must be a whole number/);
  });
});
