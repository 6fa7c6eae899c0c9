// What web/src/typeset makes of HarfBuzz's shaping tests, as JSON. node shaping.mjs FILE, which has a list of tests
import { readFileSync } from 'node:fs';
import * as hb from '../../../../web/node_modules/harfbuzzjs/dist/index.mjs';
import { TypeFont } from '../../../../web/src/typeset/font.js';
import { featuresOf, shapeRun } from '../../../../web/src/typeset/shaper.js';

const DIRECTIONS = { ltr: hb.Direction.LTR, rtl: hb.Direction.RTL, ttb: hb.Direction.TTB };

/** @type {Map<string, TypeFont>} */
const fonts = new Map();

async function fontOf(path) {
  let font = fonts.get(path);
  if (!font) {
    font = new TypeFont(fonts.size, new Uint8Array(readFileSync(path)));
    fonts.set(path, font);
    await font.load();
  }
  if (font.error) throw font.error;
  return font;
}

async function shape({ font: path, before, text, after, direction, language, features, variations }) {
  const font = await fontOf(path), list = featuresOf(features);
  if (typeof list === 'string') throw new Error(`features: ${list}`);
  const instance = font.instance(font.variationKey(variations)), whole = before + text + after;
  const shaped = shapeRun(instance, whole, before.length, before.length + text.length, DIRECTIONS[direction], { features: list, language });
  const { glyphs, advances, dx, dy, isUpright } = shaped;
  const clusters = shaped.clusters.map((cluster) => [...whole.slice(before.length, cluster)].length);
  const blank = glyphs.map((glyph, k) => !advances[k] && !instance.font.glyphExtents(glyph)?.width);
  return { em: instance.em, isUpright, glyphs, clusters, advances, dx, dy, blank };
}

const answers = [];
for (const test of JSON.parse(readFileSync(process.argv[2], 'utf-8'))) {
  answers.push(await shape(test).catch((error) => ({ error: String(error.message ?? error) })));
}
process.stdout.write(JSON.stringify({ version: hb.versionString(), answers }));
