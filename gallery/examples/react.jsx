import { Canvas, useFrame } from '@react-three/fiber';
import { Suspense, useRef, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { VectorMask, VectorMaterial } from 'vexture/react';
import { moves } from './helpers.js'; // and the style of the panel

// A balloon that sways; the one under the pointer is larger.
function Balloon({ children, sway, position: [x, y, z], ...props }) {
  const mesh = useRef();
  const [isOver, setOver] = useState(false);
  useFrame(({ clock }) => {
    const time = moves ? clock.elapsedTime : 1;
    mesh.current.position.y = y + 0.1 * sway * Math.sin(time + 2 * x);
    mesh.current.rotation.set(0, 0.4 * sway * Math.sin(0.7 * time + x), 0.05 * sway * Math.sin(1.3 * time + x));
  });
  return (
    <mesh
      ref={mesh} position={[x, y, z]} castShadow scale={isOver ? 1.1 : 1} {...props}
      onPointerOver={() => setOver(true)} onPointerOut={() => setOver(false)}
    >
      <planeGeometry args={[2.2, 2.2]} />
      {children}
    </mesh>
  );
}

function App() {
  const [count, setCount] = useState(3);
  const [sway, setSway] = useState(1);
  const [color, setColor] = useState('#2b7fb8');
  const from = (set) => ({ target }) => set(Number(target.value));
  return (
    <>
      <Canvas camera={{ position: [0, 0, innerWidth > 480 ? 7 : 9.5], fov: 45 }} style={{ height: '100vh' }}>
        <color attach="background" args={['#bfe0f2']} />
        <hemisphereLight args={['white', '#a09070', 2]} />
        <directionalLight position={[2, 3, 4]} intensity={2} />
        <Suspense fallback={null}>
          {/* the drawing, in its own colours */}
          {Array.from({ length: count }, (_, k) => (
            <Balloon key={k} sway={sway} position={[1.7 * ((k % 3) - 1), 0.9 + 0.4 * (k % 2), -1.6 * Math.floor(k / 3) - 0.6 * (k % 2)]}>
              <VectorMaterial src="balloon.ktx2" mode="paint" side={2} />
            </Balloon>
          ))}
          {/* the same on a lit banner, whose colour is around it */}
          <Balloon sway={0.3 * sway} position={[0, -1, 0.4]}>
            <meshStandardMaterial color={color} side={2}>
              <VectorMask src="balloon.ktx2" mode="paint" />
            </meshStandardMaterial>
          </Balloon>
        </Suspense>
      </Canvas>
      <details className="controls" open>
        <summary>Controls</summary>
        <div>
          <label>Balloons <input type="range" min="1" max="30" value={count} onChange={from(setCount)} /></label>
          <label>Sway <input type="range" min="0" max="2" step="any" value={sway} onChange={from(setSway)} /></label>
          <label>Banner <input type="color" value={color} onChange={({ target }) => setColor(target.value)} /></label>
        </div>
      </details>
    </>
  );
}

createRoot(document.body.appendChild(document.createElement('div'))).render(<App />);
