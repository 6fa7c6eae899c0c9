// Converts the drawings of a file, one JSON for each line, and prints which textures differ from Python's.
// node conversions.mjs DRAWINGS
import { createReadStream } from 'node:fs';
import { createInterface } from 'node:readline';
import { Conversion } from '../../web/src/convert/conversion.js';

const conversion = new Conversion();
const numbers = (text) => new Float64Array(Uint8Array.from(Buffer.from(text, 'base64')).buffer);
const found = { cases: 0, different: [], milliseconds: 0 };
for await (const line of createInterface({ input: createReadStream(process.argv[2]) })) {
  const { drawing, options, texels, roots } = JSON.parse(line);
  for (const path of drawing.paths) path.contours = path.contours.map(numbers);
  const start = performance.now();
  const made = await conversion.convert(drawing, options);
  found.milliseconds += performance.now() - start;
  found.cases += 1;
  const own = Buffer.from(made.texels.buffer);
  const described = made.roots.map(({ name, quad, isMap, paint, style }) => ({ name, quad, isMap, paint, style }));
  if (Buffer.compare(own, Buffer.from(texels, 'base64'))) found.different.push(`${drawing.name}: texels`);
  else if (JSON.stringify(described) !== JSON.stringify(roots)) found.different.push(`${drawing.name}: ${JSON.stringify(described).slice(0, 300)} for ${JSON.stringify(roots).slice(0, 300)}`);
}
process.stdout.write(JSON.stringify(found));
