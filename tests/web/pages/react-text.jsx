// Texts in a scene of React Three Fiber that shows what a test says, and draws only when something asks for a frame.
import { Canvas, useThree } from '@react-three/fiber';
import { StrictMode, Suspense, useLayoutEffect, useRef, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { Glyphs, Text } from 'vexture/text';
import { VectorText } from 'vexture/react';

const SIZE = 200;
const kernels = Object.fromEntries(['silhouettes', 'maps', 'strokes'].map((name) => [name, `${name}.wasm`]));
const glyphs = new Glyphs({ kernels, worker: () => new Worker('worker.js', { type: 'module' }) });
const clicks = [];
const errors = [];
let [show, state, text, base] = [];
let [synced, fallbacks] = [0, 0];

function Spy() {
  state = useThree();
  return null;
}

function Fallback() {
  useLayoutEffect(() => void fallbacks++, []);
  return null;
}

function Item({ words, material, ...props }) {
  const ref = useRef(null);
  useLayoutEffect(() => {
    text = ref.current;
  });
  return (
    <VectorText
      ref={ref} font="font.ttf" glyphs={glyphs} color="black" {...props} onClick={({ charIndex }) => clicks.push(charIndex)}
      onSync={(one) => (synced += one instanceof Text)} onError={(error) => errors.push(error.message)}
    >
      {words}
      {material && <meshLambertMaterial ref={(one) => (base = one ?? base)} {...material} />}
    </VectorText>
  );
}

function App() {
  const [items, set] = useState([]);
  show = set;
  return (
    <Canvas
      orthographic flat dpr={1} frameloop="demand" style={{ width: SIZE, height: SIZE }}
      camera={{ zoom: 1, position: [0, 0, 5] }} gl={{ preserveDrawingBuffer: true, antialias: false }}
    >
      <Spy />
      <ambientLight intensity={Math.PI} />
      <color attach="background" args={['white']} />
      <Suspense fallback={<Fallback />}>
        {items.map(({ name, ...item }, place) => <Item key={name ?? place} {...item} />)}
      </Suspense>
    </Canvas>
  );
}

const patiently = async (found) => {
  for (let left = 1000; !found(); left--) {
    if (left === 0) throw new Error('waited in vain');
    await new Promise((done) => setTimeout(done, 10));
  }
};

// The picture, once the texts are set and no frame is asked for: its bytes, the top row first.
async function draw(items, isChanged = true) {
  const before = synced + errors.length;
  show(items);
  await patiently(() => !isChanged || synced + errors.length > before);
  await new Promise((done) => setTimeout(done, 50));
  await patiently(() => state.internal.frames === 0);
  const gl = state.gl.getContext(), row = 4 * SIZE, data = new Uint8Array(SIZE * row);
  gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.UNSIGNED_BYTE, data);
  const rows = Array.from({ length: SIZE }, (_, k) => data.subarray(row * (SIZE - 1 - k), row * (SIZE - k)));
  return rows.flatMap((one) => [...one]);
}

createRoot(document.body.appendChild(document.createElement('div'))).render(<StrictMode><App /></StrictMode>);
document.body.style.margin = '0';

window.page = {
  draw, clicks, errors,
  ready: () => patiently(() => state),
  fallbacks: () => fallbacks,
  held: () => ({ geometries: state.gl.info.memory.geometries, programs: state.gl.info.programs.length, children: state.scene.children.length }),
  text: () => ({ text: text.text, isText: text instanceof Text, kind: text.material.type, outlineWidth: text.outlineWidth, isDisposed: text.isDisposed }),
  recolour: async (color) => {
    base.color.set(color);
    state.invalidate();
    return draw((items) => items, false);
  },
};
