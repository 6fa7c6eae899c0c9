// Code that shows the drawing, for the visitor's own page.

/** @typedef {{ name: string, code: (file: string) => string }} Snippet */

/** @type {Snippet[]} */
export const SNIPPETS = [
  {
    name: 'three.js',
    code: (file) => `// npm install three vexture
import * as THREE from 'three';
import { VectorMaterial, VectorTextureLoader } from 'vexture';

const renderer = new THREE.WebGLRenderer({ antialias: true });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.01, 100);
camera.position.z = 3;

const texture = await new VectorTextureLoader().loadAsync('/${file}');
scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new VectorMaterial({ texture })));
renderer.setAnimationLoop(() => renderer.render(scene, camera));
`,
  },
  {
    name: 'React',
    code: (file) => `// npm install three @react-three/fiber vexture
import { Canvas } from '@react-three/fiber';
import { Suspense } from 'react';
import { VectorMaterial } from 'vexture/react';

export default function App() {
  return (
    <Canvas style={{ height: '100vh' }}>
      <Suspense fallback={null}>
        <mesh rotation-y={0.5}>
          <planeGeometry args={[4, 4]} />
          <VectorMaterial src="/${file}" mode="paint" side={2} />
        </mesh>
      </Suspense>
    </Canvas>
  );
}
`,
  },
  {
    name: 'WebGPU',
    code: (file) => `// npm install three vexture
import * as THREE from 'three/webgpu';
import { VectorNodeMaterial, VectorTextureLoader } from 'vexture/webgpu';

const renderer = new THREE.WebGPURenderer({ antialias: true });
await renderer.init();
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.01, 100);
camera.position.z = 3;

const texture = await new VectorTextureLoader().loadAsync('/${file}');
scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new VectorNodeMaterial({ texture })));
renderer.setAnimationLoop(() => renderer.render(scene, camera));
`,
  },
  {
    name: 'Convert in the page',
    code: () => `// npm install three vexture
import { VectorMaterial } from 'vexture';
import { convert } from 'vexture/convert';

const texture = await convert('/logo.svg'); // or the text of an SVG, a File, an <svg> element, GeoJSON
const material = new VectorMaterial({ texture });
for (const { kind, message, count } of texture.notes) console.log(\`\${kind}: \${message} (\${count})\`);
`,
  },
];
