// Calls kernels of kernels.wasm with the cases of a file, one JSON for each line, and prints which results differ.
// node kernel_cases.mjs KERNELS.wasm CASES
import { createReadStream, readFileSync } from 'node:fs';
import { createInterface } from 'node:readline';
import { ARRAYS, Kernels } from '../../web/src/convert/kernels.js';

const [module, cases] = process.argv.slice(2);
const kernels = await Kernels.load(readFileSync(module));

/** Values of Python as JavaScript has them: arrays are [type, base64]. */
const decoded = (value) => {
  if (value?.numbers === undefined) return value;
  const bytes = Uint8Array.from(Buffer.from(value.numbers, 'base64')).buffer;
  return { values: new ARRAYS[value.type](bytes), shape: value.shape };
};

const same = (one, other) => {
  const bits = (array) => Buffer.from(array.buffer, array.byteOffset, array.byteLength);
  return ArrayBuffer.isView(one) ? Buffer.compare(bits(one), bits(other.values)) === 0 : Object.is(one, other);
};

const found = { cases: 0, different: [], milliseconds: 0 };
for await (const line of createInterface({ input: createReadStream(cases) })) {
  const { kernel, name, given, results } = JSON.parse(line);
  const values = given.map((value) => (Array.isArray(value) ? value.map(decoded) : decoded(value)));
  const start = performance.now();
  const got = kernels.call(kernel, values);
  found.milliseconds += performance.now() - start;
  found.cases += 1;
  if (!Object.values(got).every((part, place) => same(part, decoded(results[place])))) found.different.push(name);
}
process.stdout.write(JSON.stringify(found));
