// Code that shows the drawing, for the visitor's own page.

/** @typedef {{ name: string, code: (file: string) => string }} Snippet */

/**
 * A whole page by three.js.
 *
 * @param {string} file
 * @param {'WebGL' | 'WebGPU'} kind
 */
function pageOf(file, kind) {
  const isGpu = kind === 'WebGPU';
  const [modules, material] = isGpu ? ['/webgpu', 'VectorNodeMaterial'] : ['', 'VectorMaterial'];
  return `// npm install three vexture
import * as THREE from 'three${modules}';
import { ${material}, VectorTextureLoader } from 'vexture${modules}';

const renderer = new THREE.${kind}Renderer({ antialias: true });
${isGpu ? 'await renderer.init();\n' : ''}renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.01, 100);
camera.position.z = 3;

const texture = await new VectorTextureLoader().loadAsync('/${file}');
scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new ${material}({ texture })));
renderer.setAnimationLoop(() => renderer.render(scene, camera));
`;
}

/** @type {Snippet[]} */
export const SNIPPETS = [
  { name: 'three.js', code: (file) => pageOf(file, 'WebGL') },
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
  { name: 'WebGPU', code: (file) => pageOf(file, 'WebGPU') },
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
