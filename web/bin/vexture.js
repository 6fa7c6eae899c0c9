#!/usr/bin/env node
// The command `vexture convert` of npm: conversion to files without Python. Options have the names of the Python program's.
import { mkdir, readFile, rename, rm, stat, writeFile } from 'node:fs/promises';
import { dirname, join, parse } from 'node:path';
import { parseArgs } from 'node:util';
import { convertData, writePacked } from '../src/convert/index.js';

const HELP = `Usage: npx vexture convert [OPTIONS] SOURCE...

Convert drawings into textures: SVG, GeoJSON or TopoJSON, plain or gzipped; - is standard input.
The Python program (uvx vexture) reads more, such as texts, pictures and geographic data.

  -o, --output DIR|FILE.ktx2|-    Folder to write to, or the file for one drawing; - is standard output. [default: .]
  --split [auto|faces|paint]      How a drawing becomes shapes. [default: auto]
  --silhouette                    Convert the covered area of a drawing, without colours.
  --restyle                       A planar map whose elements can get other colours later.
  --names NAME                    Name elements by a property of GeoJSON, rather than by id.
  --tolerance T                   Largest distance from the outline, in unit-square units. [default: 2e-5]
  --max-depth D                   Divide cells no further than this depth. [default: 16]
  --capacity N                    Pieces in a leaf, 1 to 15. [default: 8, in colours 12]
  --precision P                   Largest shift by rounding, in unit-square units.
  --max-seconds S                 Most seconds for one source. [default: 60]
  --strict                        Fail, and write nothing, where anything of a drawing is left out, simplified or invalid.
  -q, --quiet                     Print errors only.
  --version                       Print the version.
  -h, --help                      Print this text.
`;

const text = { type: 'string' };
const flag = { type: 'boolean' };
const OPTIONS = {
  output: { ...text, short: 'o', default: '.' }, split: text, silhouette: flag, restyle: flag, names: text, tolerance: text,
  'max-depth': text, capacity: text, precision: text, 'max-seconds': text, strict: flag, quiet: { ...flag, short: 'q' }, version: flag,
  help: { ...flag, short: 'h' },
};
const NUMBERS = { tolerance: 'tolerance', 'max-depth': 'maxDepth', capacity: 'capacity', precision: 'precision', 'max-seconds': 'maxSeconds' };

/** @param {string} message */
const say = (message) => process.stderr.write(`vexture: ${message}\n`);

/** @param {Record<string, any>} values of the command line @returns {object} options of `convertData` */
function optionsOf(values) {
  if (values.silhouette && values.split) throw new Error('--silhouette and --split exclude each other; leave one out');
  const numbers = Object.entries(NUMBERS).filter(([name]) => name in values).map(([name, key]) => {
    const value = values[name].trim() ? Number(values[name]) : NaN;
    return [key, Number.isNaN(value) ? values[name] : value]; // the conversion refuses what is no number
  });
  const { restyle, names } = values;
  return { ...Object.fromEntries(numbers), restyle, names, split: values.silhouette ? null : values.split };
}

/** @param {string} source @returns {string} name of its texture */
const nameOf = (source) => (source === '-' ? 'drawing' : parse(source.replace(/\.gz$/i, '')).name);

/** @param {string[]} sources @param {string} output @returns {Promise<string[]>} the file for each, or - */
async function placesOf(sources, output) {
  const isFile = output === '-' || (/\.ktx2$/i.test(output) && !(await stat(output).catch(() => null))?.isDirectory());
  if (isFile && sources.length > 1) throw new Error(`${output} is one file for ${sources.length} sources; give a folder`);
  const places = sources.map((source) => (isFile ? output : join(output, `${nameOf(source)}.ktx2`)));
  const twice = places.findIndex((place, k) => places.indexOf(place) < k);
  if (twice >= 0) throw new Error(`${sources[places.indexOf(places[twice])]} and ${sources[twice]} would both be ${places[twice]}; rename one`);
  await mkdir(isFile ? dirname(output) : output, { recursive: true });
  return places;
}

/** @param {string} place @param {Uint8Array} bytes which are there in full or not at all */
async function write(place, bytes) {
  if (place === '-') return void process.stdout.write(bytes);
  const partial = `${place}.${process.pid}.partial`;
  try {
    await writeFile(partial, bytes);
    await rename(partial, place);
  } catch (error) {
    await rm(partial, { force: true });
    throw error;
  }
}

/** @param {string} source @returns {Promise<Uint8Array>} */
async function contentOf(source) {
  if (source === '-') return Buffer.concat(await process.stdin.toArray());
  return readFile(source).catch((error) => {
    throw new Error(`cannot be read (${error.message}); check the file's name and permissions`);
  });
}

/** @param {string} source @param {string} place @param {object} options @param {Record<string, any>} values of the command line */
async function convertFile(source, place, options, { strict, quiet }) {
  const content = await contentOf(source);
  const data = await convertData(content, { name: nameOf(source), ...options });
  const lost = data.notes.map(({ kind, message, count }) => `${kind === 'remark' ? '' : `${kind}: `}${message}${count > 1 ? ` (${count})` : ''}`);
  if (strict && data.notes.some(({ kind }) => kind !== 'remark')) throw new Error(`${lost.join('; ')}; change the drawing, or convert it without --strict`);
  const bytes = await writePacked(data);
  await write(place, bytes);
  if (quiet) return;
  for (const note of lost) say(`warning: ${source}: ${note}`);
  if (place !== '-') say(`${place}: ${bytes.length.toLocaleString('en-US')} bytes`);
}

/** @param {unknown} error @returns {string} its message in one line */
const lineOf = (error) => (error instanceof Error ? error.message : String(error)).replace(/\s+/g, ' ').trim();

/** @returns {Promise<boolean>} whether all is done */
async function main() {
  const { values, positionals: [command, ...sources] } = parseArgs({ options: OPTIONS, allowPositionals: true });
  if (values.help || (!command && !values.version)) return process.stdout.write(HELP), Boolean(values.help);
  if (values.version) return process.stdout.write(`${JSON.parse(await readFile(new URL('../package.json', import.meta.url), 'utf8')).version}\n`), true;
  if (command !== 'convert') throw new Error(`'${command}' is no command; there is convert`);
  if (!sources.length) throw new Error('no sources; give SVG or GeoJSON files');
  const [options, places] = [optionsOf(values), await placesOf(sources, values.output)];
  let failed = 0;
  for (const [k, source] of sources.entries()) {
    await convertFile(source, places[k], options, values).catch((error) => {
      failed++;
      say(`${source}: ${lineOf(error).replace(`${nameOf(source)}: `, '')}`);
    });
  }
  if (failed && sources.length > 1) say(`${failed} of ${sources.length} files failed`);
  return failed === 0;
}

main().then((isDone) => {
  process.exitCode = isDone ? 0 : 1;
}, (error) => {
  say(lineOf(error));
  process.exitCode = 1;
});
