// Frame times of one scene drawn by VectorMaterial, for flat views and for any, and by the band algorithm: in turns, in one page.

import * as THREE from 'three';
import { VectorMaterial, VectorTexture, readPacked } from 'vexture';

const BAND_VERTEX = /* glsl */ `
varying vec2 place;
void main() {
    place = uv;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const BAND_FRAGMENT = /* glsl */ `
varying vec2 place;
void main() {
    gl_FragColor = vec4(vec3(0.0), band_coverage(place, dFdx(place), dFdy(place)));
    #include <colorspace_fragment>
}`;

/** Bytes of a base64 text. */
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

function bandMaterial({ lists, outlines, width, box, shader }) {
    const texture = (data, channels, format, type, internalFormat) => {
        const made = new THREE.DataTexture(data, width, data.length / width / channels, format, type);
        made.internalFormat = internalFormat;
        made.needsUpdate = true;
        return made;
    };
    return new THREE.ShaderMaterial({
        transparent: true,
        uniforms: {
            band_lists: {
                value: texture(new Uint32Array(bytes(lists).buffer), 1, THREE.RedIntegerFormat, THREE.UnsignedIntType, 'R32UI'),
            },
            outlines: {
                value: texture(new Float32Array(bytes(outlines).buffer), 4, THREE.RGBAFormat, THREE.FloatType, 'RGBA32F'),
            },
            band_box: { value: new THREE.Vector4(...box) },
        },
        vertexShader: BAND_VERTEX,
        fragmentShader: shader + BAND_FRAGMENT,
    });
}

/** Materials of each shape by the name of the method. */
async function materials(shapes) {
    const found = { packed: [], any: [], bands: [] };
    for (const { packed, bands } of shapes) {
        const texture = new VectorTexture(await readPacked(bytes(packed).buffer));
        found.packed.push(new VectorMaterial({ texture, flat: true, color: 0x000000 }));
        found.any.push(new VectorMaterial({ texture, color: 0x000000 }));
        found.bands.push(bandMaterial(bands));
    }
    return found;
}

/** Squares side by side, as many columns as rows or one more, each the box of its shape. */
function sheet(shapes, made, repeat) {
    const scene = new THREE.Scene();
    scene.background = new THREE.Color(1, 1, 1);
    const columns = Math.ceil(Math.sqrt(repeat));
    for (let i = 0; i < repeat; i++) {
        const { box } = shapes[i % shapes.length];
        const geometry = new THREE.PlaneGeometry(1, 1);
        const uv = geometry.getAttribute('uv');
        for (let k = 0; k < uv.count; k++) {
            uv.setXY(k, box[0] + uv.getX(k) * (box[2] - box[0]), box[1] + uv.getY(k) * (box[3] - box[1]));
        }
        const mesh = new THREE.Mesh(geometry, made[i % made.length]);
        mesh.position.set((i % columns) + 0.5, columns - Math.floor(i / columns) - 0.5, 0);
        scene.add(mesh);
    }
    return { scene, columns };
}

function camera(view, columns) {
    if (view.tilt) {
        const found = new THREE.PerspectiveCamera(40, 1, 0.01, 100 * columns);
        const away = (0.5 * columns) / Math.tan(THREE.MathUtils.degToRad(20));
        const angle = THREE.MathUtils.degToRad(view.tilt);
        found.position.set(columns / 2, columns / 2 - away * Math.sin(angle), away * Math.cos(angle));
        found.up.set(0, Math.cos(angle), Math.sin(angle));
        found.lookAt(columns / 2, columns / 2, 0);
        return found;
    }
    const [x, y] = view.at ?? [columns / 2, columns / 2];
    const half = columns / (view.zoom ?? 1) / 2;
    const found = new THREE.OrthographicCamera(x - half, x + half, y + half, y - half, -1, 1);
    return found;
}

/**
 * Milliseconds of a frame, for each view and method: one figure for each round.
 *
 * @param {{shapes: object[], views: Record<string, object>, side: number, rounds: number, least: number}} order
 *     least: milliseconds that one measurement lasts
 */
async function measure({ shapes, views, side, rounds, least }) {
    const renderer = new THREE.WebGLRenderer();
    renderer.setPixelRatio(1);
    renderer.setSize(side, side);
    document.body.append(renderer.domElement);
    const gl = renderer.getContext();
    const pixel = new Uint8Array(4);
    const made = await materials(shapes);
    const times = {};
    for (const [name, view] of Object.entries(views)) {
        const shown = view.tilt ? { ...made, packed: made.any } : made;
        const drawn = Object.entries(shown).map(([method, list]) => {
            const { scene, columns } = sheet(shapes, list, view.repeat ?? shapes.length);
            return { method, scene, camera: camera(view, columns) };
        });
        const frames = (one, count) => {
            const start = performance.now();
            for (let i = 0; i < count; i++) renderer.render(one.scene, one.camera);
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
            return (performance.now() - start) / count;
        };
        const counts = drawn.map((one) => {
            frames(one, 1);
            return Math.max(1, Math.ceil(least / frames(one, 2)));
        });
        times[name] = Object.fromEntries(drawn.map(({ method }) => [method, []]));
        for (let round = 0; round < rounds; round++) {
            drawn.forEach((one, k) => times[name][one.method].push(frames(one, counts[k])));
        }
        times[name].pictures = drawn.map((one) => {
            renderer.render(one.scene, one.camera);
            return renderer.domElement.toDataURL();
        });
    }
    const debug = gl.getExtension('WEBGL_debug_renderer_info');
    return { times, driver: gl.getParameter(debug ? debug.UNMASKED_RENDERER_WEBGL : gl.RENDERER), three: THREE.REVISION };
}

window.measure = measure;
