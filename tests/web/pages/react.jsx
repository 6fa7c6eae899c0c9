// A scene of React Three Fiber that shows what a test says, and draws only when something asks for a frame.
import { Canvas, useFrame, useThree } from '@react-three/fiber';
import { Component, StrictMode, Suspense, useEffect, useLayoutEffect, useMemo, useState } from 'react';
import { createRoot } from 'react-dom/client';
import * as THREE from 'three';
import { vectorMaskOf } from 'vexture';
import { VectorMask, VectorMaterial, useFold, useVectorTexture } from 'vexture/react';

const SIZE = 256;
const clicks = [];
const failures = [];
let change;
let changed;
let show;
let state;
let fallbacks = 0;
let frames = 0;
let loading = 0;
let [wanted, shown] = [0, -1];

// Keeps what the page may look at, and says which scene is there.
function Spy({ version }) {
  state = useThree();
  useFrame(() => void frames++);
  useEffect(() => void (shown = version));
  return null;
}

function Fallback() {
  useLayoutEffect(() => {
    fallbacks++;
    loading++;
    return () => void loading--;
  }, []);
  return null;
}

class Boundary extends Component {
  state = { error: null };

  static getDerivedStateFromError(error) {
    return { error };
  }

  componentDidCatch(error) {
    failures.push(String(error));
  }

  render() {
    return this.state.error ? null : this.props.children;
  }
}

// Options as JSON says them.
function completed({ transform, ...props }) {
  return transform ? { ...props, transform: new THREE.Matrix3().fromArray(transform).transpose() } : props;
}

// It can change by itself, so that nothing else asks for a frame.
function Shape({ texture, fold, ...props }) {
  const shared = useVectorTexture(texture);
  const [own, set] = useState({});
  change = set;
  useEffect(() => void (changed = own));
  const options = { ...completed({ ...props, ...own }), texture: shared };
  return fold ? <Folded fold={fold} {...options} /> : <VectorMaterial {...options} />;
}

function Folded({ fold, ...options }) {
  return <VectorMaterial fold={useFold(fold)} {...options} />;
}

// A mask in a material; `fresh` makes another material, of which the mask is not told.
function Masked({ color, fresh = 0, ...props }) {
  const mask = useMemo(() => props.src && <VectorMask {...completed(props)} />, [JSON.stringify(props)]);
  const args = useMemo(() => [{ name: String(fresh) }], [fresh]);
  return (
    <meshBasicMaterial args={args} color={color} toneMapped={false}>
      {mask}
    </meshBasicMaterial>
  );
}

const kinds = {
  // a material with a texture that several share
  shared: (props) => <Shape {...props} />,
  // a material that loads its texture
  loading: (props) => <VectorMaterial {...completed(props)} />,
  masked: Masked,
};

function Item({ name, kind, x = 0, width = 2, props, inMesh }) {
  const Kind = kinds[kind];
  return (
    <mesh position-x={x} scale-x={width / 2} onClick={({ element, uv }) => clicks.push(element?.name ?? uv.x)}>
      <planeGeometry args={[2, 2]} />
      {inMesh ? <meshBasicMaterial color={props.color} toneMapped={false} /> : <Kind {...props} />}
      {inMesh && <VectorMask {...completed(props)} />}
    </mesh>
  );
}

function App() {
  const [{ items, version }, set] = useState({ items: [], version: wanted });
  show = set;
  return (
    <Canvas
      orthographic flat={false} dpr={1} frameloop="demand" style={{ width: SIZE, height: SIZE }}
      camera={{ zoom: SIZE / 2, position: [0, 0, 5] }} gl={{ preserveDrawingBuffer: true, antialias: false }}
    >
      <Spy version={version} />
      <color attach="background" args={['white']} />
      {items.map((item, place) => (
        <Boundary key={item.name ?? place}>
          <Suspense fallback={<Fallback />}>
            <Item {...item} />
          </Suspense>
        </Boundary>
      ))}
    </Canvas>
  );
}

const patiently = async (found) => {
  for (let left = 500; !found(); left--) {
    if (left === 0) throw new Error('waited in vain');
    await new Promise((done) => setTimeout(done, 10));
  }
};

// The picture, once all is loaded and no frame is asked for.
async function settled() {
  await patiently(() => shown === wanted && loading === 0 && state.internal.frames === 0);
  const gl = state.gl.getContext();
  const data = new Uint8Array(4 * SIZE * SIZE);
  gl.readPixels(0, 0, SIZE, SIZE, gl.RGBA, gl.UNSIGNED_BYTE, data);
  let text = '';
  for (let i = 0; i < data.length; i += 4096) text += String.fromCharCode(...data.subarray(i, i + 4096));
  return btoa(text);
}

async function draw(items) {
  show({ items, version: ++wanted });
  return settled();
}

// The picture after a change of nothing but the last material.
async function alter(props) {
  change(props);
  await patiently(() => changed === props);
  return settled();
}

const meshes = () => state.scene.children.filter(({ isMesh }) => isMesh);

// What is on the GPU, and which masks there are.
const held = () => ({
  textures: state.gl.info.memory.textures,
  programs: state.gl.info.programs.length,
  masks: meshes().map(({ material }) => Boolean(vectorMaskOf(material))),
  cut: meshes().map((mesh) => [Object.hasOwn(mesh, 'raycast'), Boolean(mesh.customDepthMaterial)]),
});

createRoot(document.body.appendChild(document.createElement('div'))).render(<StrictMode><App /></StrictMode>);
document.body.style.margin = '0';

window.page = {
  draw, alter, held, settled, clicks, failures, patiently,
  ready: () => patiently(() => shown === wanted),
  fallbacks: () => fallbacks,
  frames: () => frames,
  wait: (seconds) => {
    state.clock.oldTime -= 1000 * seconds; // as if it had been
    state.invalidate();
  },
  toneMapping: () => state.gl.toneMapping === THREE.ACESFilmicToneMapping,
  preload: useVectorTexture.preload,
  clear: useVectorTexture.clear,
};
