// A plane with a shape on it, in perspective: a picture, and where the plane's square is in it.

import * as THREE from 'three';
import { VectorMaterial, VectorTexture, readPacked } from 'vexture';

/**
 * @param {{packed: string, side: number, tilt: number}} order tilt: degrees that the plane leans back
 * @returns {Promise<{picture: string, matrix: number[]}>} the matrix from the plane to the screen, by columns
 */
async function draw({ packed, side, tilt }) {
    const data = await readPacked(Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0)).buffer);
    const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
    renderer.setPixelRatio(1);
    renderer.setSize(side, side);
    const scene = new THREE.Scene();
    scene.background = new THREE.Color(1, 1, 1);
    const material = new VectorMaterial({ texture: new VectorTexture(data), color: 0x000000 });
    const mesh = new THREE.Mesh(new THREE.PlaneGeometry(1, 1), material);
    mesh.rotation.x = -THREE.MathUtils.degToRad(tilt);
    scene.add(mesh);
    const camera = new THREE.PerspectiveCamera(30, 1, 0.1, 10);
    camera.position.z = 1.9;
    renderer.render(scene, camera);
    const matrix = camera.projectionMatrix.clone().multiply(mesh.modelViewMatrix);
    const picture = renderer.domElement.toDataURL();
    renderer.dispose();
    return { picture, matrix: matrix.elements };
}

window.draw = draw;
