import harfbuzz from 'harfbuzzjs/dist/harfbuzz.wasm';
import font from 'vexture-fonts/noto-sans.woff';
import maps from 'vexture-kernels/maps.wasm';
import silhouettes from 'vexture-kernels/silhouettes.wasm';
import strokes from 'vexture-kernels/strokes.wasm';
import program from 'vexture-text-worker';
import * as vexture from 'vexture/text';

// A page from the disk may load no file, nor start a module as a worker: all is in this script, and the worker is a function.
const address = 'new URL("harfbuzz.wasm","worker:").href';
if (!program.includes(address)) throw new Error(`the worker of texts no longer loads HarfBuzz by ${address}`);
const text = `(async () => { 'use strict'; ${program.replace(address, JSON.stringify(harfbuzz))} })();`;
const source = URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));

function worker() {
  const started = new Worker(source);
  const files = globalThis.galleryFiles ?? {};
  const send = started.postMessage.bind(started);
  // fonts of the example are given, as files are to its own `fetch`
  started.postMessage = (message) => {
    const name = typeof message.font?.source === 'string' ? message.font.source.split('/').at(-1) : '';
    send(name in files ? { ...message, font: { ...message.font, source: files[name] } } : message);
  };
  return started;
}

vexture.Glyphs.shared = new vexture.Glyphs({ worker, kernels: { silhouettes, maps, strokes } });
vexture.setDefaultFont(font);
Object.assign(globalThis.galleryModules, { 'vexture/text': vexture });
