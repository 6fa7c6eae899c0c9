import { Canvas, useFrame } from '@react-three/fiber';
import { Suspense, useRef, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { VectorMask, VectorMaterial } from 'vexture/react';

const isStill = matchMedia('(prefers-reduced-motion: reduce)').matches;

// A badge that turns; the one under the pointer is larger.
function Badge({ children, ...props }) {
  const mesh = useRef();
  const [isOver, setOver] = useState(false);
  useFrame(({ clock }) => {
    mesh.current.rotation.y = isStill ? 0.4 : 0.6 * Math.sin(clock.elapsedTime + props.position[0]);
  });
  return (
    <mesh
      ref={mesh} castShadow scale={isOver ? 1.15 : 1} {...props}
      onPointerOver={() => setOver(true)} onPointerOut={() => setOver(false)}
    >
      <planeGeometry args={[1.8, 1.8]} />
      {children}
    </mesh>
  );
}

function App() {
  const [color, setColor] = useState('#c8553d');
  return (
    <Canvas shadows="percentage" camera={{ position: [0, 0.4, innerWidth > innerHeight ? 5 : 9], fov: 45 }} style={{ height: '100vh' }}>
      <color attach="background" args={['#efe6d6']} />
      <hemisphereLight args={['white', '#a09070', 1.6]} />
      <directionalLight castShadow position={[2, 3, 4]} intensity={2} />
      <Suspense fallback={null}>
        {/* the drawing, in its own colours */}
        <Badge position={[-1.3, 0, 0]}>
          <VectorMaterial src="logo.ktx2" mode="paint" side={2} />
        </Badge>
        {/* the same over a lit material, which a click colours */}
        <Badge position={[1.3, 0, 0]} onClick={() => setColor(`hsl(${360 * Math.random()} 50% 50%)`)}>
          <meshStandardMaterial color={color} side={2}>
            <VectorMask src="logo.ktx2" mode="paint" />
          </meshStandardMaterial>
        </Badge>
      </Suspense>
      <mesh receiveShadow position-z={-1.2}>
        <planeGeometry args={[40, 20]} />
        <meshStandardMaterial color="#e3d7c0" />
      </mesh>
    </Canvas>
  );
}

createRoot(document.body.appendChild(document.createElement('div'))).render(<App />);
