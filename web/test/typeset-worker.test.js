// The worker of texts, in this thread: it answers what comes before it is loaded, and outlives errors.
import { afterAll, beforeAll, expect, it } from 'vitest';
import { describeWithKernels } from './built-kernels.js';
import { PACIFICO, fontFile } from './typeset-fonts.js';

describeWithKernels('the worker', () => {
  const scope = /** @type {any} */ (globalThis);
  /** @type {any[]} */
  const posted = [];
  const until = async (count) => {
    while (posted.length < count) await new Promise((resolve) => setTimeout(resolve, 5));
  };
  beforeAll(async () => {
    scope.postMessage = (reply, transfer) => posted.push({ reply, transfer });
    await import('../src/typeset/worker.js');
  });
  afterAll(() => {
    delete scope.postMessage;
    delete scope.onmessage;
  });

  it('answers in order what it was told at once', async () => {
    for (const data of [{ kernels: undefined }, { font: { id: 0, source: fontFile(PACIFICO) } }]) scope.onmessage({ data });
    scope.onmessage({ data: { id: 1, texts: [{ text: 'ab', fonts: [0] }] } });
    scope.onmessage({ data: { id: 2, texts: [{ text: 'bc', fonts: [0] }] } });
    await until(2);
    const [one, two] = posted.map(({ reply }) => reply);
    expect([one.id, two.id]).toEqual([1, 2]);
    expect(one.added.firstShape).toBe(0);
    expect(two.added.firstShape).toBe(one.added.shapes.length);
    expect(two.added.first).toBe(one.added.words.length / 4);
    expect(posted[0].transfer).toContain(one.added.words.buffer);
    expect(structuredClone(one, { transfer: posted[0].transfer }).results[0].shapes.length).toBe(2);
  });

  it('names what is wrong, and goes on', async () => {
    scope.onmessage({ data: { font: { id: 1, source: 'x', unicodeRange: 'letters' } } });
    scope.onmessage({ data: { id: 3, texts: [{ text: 'ab', fonts: [1] }] } });
    scope.onmessage({ data: { id: 4, texts: 7 } });
    scope.onmessage({ data: null });
    scope.onmessage({ data: { id: 5, texts: [{ text: 'ab', fonts: [0] }] } });
    await until(5);
    const [three, four, five] = [3, 4, 5].map((id) => posted.find(({ reply }) => reply.id === id).reply);
    expect(three.results[0]).toEqual({ error: 'the unicodeRange "letters" is none; write U+26, U+0-7F or U+4??, with commas', field: 'unicodeRange' });
    expect(four).toMatchObject({ id: 4, error: { field: 'texts' } });
    expect(five.results[0].shapes.length).toBe(2);
  });

  it('says which kernels cannot be loaded', async () => {
    scope.onmessage({ data: { kernels: { silhouettes: 'http://127.0.0.1:1/none.wasm' } } });
    scope.onmessage({ data: { font: { id: 0, source: fontFile(PACIFICO) } } });
    scope.onmessage({ data: { id: 6, texts: [{ text: 'xyz', fonts: [0], strokeWidth: 0.1 }] } });
    await until(6);
    expect(posted[5].reply.id).toBe(6);
  });
});
