// Everything that the package offers to a project of React and TypeScript, in the settings of a newcomer.
import { Canvas } from '@react-three/fiber';
import { Suspense, useRef, useState } from 'react';
import { Color, InstancedMesh, Matrix3, Mesh, MeshStandardMaterial, PlaneGeometry, Raycaster, Texture } from 'three';
import * as vexture from 'vexture';
import type {
  AnyVectorTexture, Bytes, FoundElement, LiveOptions, MaskOptions, Masked, MaskedIntersection, OnProgress, PackedData,
  Paint, PaintList, Root, RootChoice, RootPaint, TextureData, VectorMaterialParameters, VectorTextureEvents,
} from 'vexture';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { VectorGlobe, openTiles } from 'vexture/globe';
import { VectorTexturePlugin } from 'vexture/gltf';
import { VectorTileLayer } from 'vexture/maplibre';
import {
  VectorMask, VectorMaterial, VectorText, useFold, useVectorTexture, type VectorMaskProps, type VectorMaterialProps,
  type VectorTextProps,
} from 'vexture/react';
import {
  BatchedText, Glyphs, Text, getCaretAtPoint, getSelectionRects, type FontFace, type TextLayout, type TextOptions,
} from 'vexture/text';
import * as nodes from 'vexture/webgpu';
import { ThesisLoader, ThesisTexture, readThesis, type ThesisData } from 'vexture/thesis';
import {
  SimpleWater, VectorWater, chooseWater, waterNormals, type Calm, type DepthColors, type Foam, type SimpleWaterOptions,
  type VectorWaterOptions,
} from 'vexture/water';
import logo from './logo.svg?vexture';
import map from './map.geojson?restyle&vexture';

const paints: PaintList = { Delft: '#c00', Leiden: [0, 0.4, 0.8, 1], Gouda: null, Utrecht: 'own', Breda: new Color() };
const list: PaintList = new Map<string, Paint>([['Delft', 0xcc0000]]);

/** All options but those that go by the kind of the material. */
function options(fold: vexture.FoldTexture): MaskOptions {
  return {
    root: 'logo', transform: new Matrix3(), wrap: 'repeat', flat: true, invert: false, threshold: 0.5, linear: true,
    instanced: false, fold, time: 1, background: 'own', mode: 'mix', color: 'tomato', map: new Texture(),
  };
}

export function Logo(props: VectorMaterialProps) {
  const material = useRef<vexture.VectorMaterial>(null);
  const [isHot, setHot] = useState(false);
  const texture = useVectorTexture(logo, (loader) => loader.setPath('/textures/'));
  const pair: vexture.VectorTexture[] = useVectorTexture([logo, map]);
  const fold = useFold('/logo.fold.ktx2');
  const { mode: _mode, color: _color, map: _map, ...common } = options(fold);
  return (
    <mesh onClick={() => material.current && (material.current.mode = 'cut')} onPointerOver={() => setHot(!isHot)}>
      <planeGeometry />
      <VectorMaterial ref={material} texture={texture} mode="paint" colors={isHot ? paints : null} {...common} {...props} />
      <VectorMaterial src={map} root={2} color={isHot ? 'red' : 0xff0000} toneMapped side={2} attach="material-1" />
      <VectorMaterial texture={pair[0]} wrap="clamp" opacity={0.5} transparent />
    </mesh>
  );
}

function Wall(props: VectorMaskProps) {
  const mask = useRef<vexture.VectorMask>(null);
  return (
    <mesh castShadow>
      <meshStandardMaterial color="white">
        <VectorMask ref={mask} src={map} colors={list} mode="mix" color="red" {...props} />
      </meshStandardMaterial>
    </mesh>
  );
}

/** What is hovered, as the README has it. */
export function Hovered({ onHover }: { onHover: (name?: string) => void }) {
  return (
    <mesh onPointerMove={(event) => onHover(event.element?.name)}>
      <VectorMaterial src={map} mode="paint" />
    </mesh>
  );
}

export function App() {
  return (
    <Canvas>
      <Suspense fallback={null}>
        <Logo key="logo" />
        <Wall mode="cut" />
      </Suspense>
    </Canvas>
  );
}

/** A text with a material of its own, as the guide to texts has it. */
export function Score({ points, ...props }: VectorTextProps & { points: number }) {
  const text = useRef<Text>(null);
  return (
    <VectorText ref={text} fontSize={0.4} anchorY="bottom" position={[0, 1, 0]} onSync={(one) => one.layout} suspend {...props}>
      {points} points
      <meshStandardMaterial color="orange" />
    </VectorText>
  );
}

/** Texts without React. */
export async function texts(faces: FontFace[]): Promise<void> {
  const options: Partial<TextOptions> = { text: 'Hello', font: faces, fontWeight: 'bold', outlineWidth: '5%' };
  const text = new Text({ ...options, material: new MeshStandardMaterial(), glyphs: new Glyphs({ budget: 2 ** 20 }) });
  text.color = 'red';
  await text.sync();
  const layout: TextLayout | null = text.layout;
  if (layout) console.log(getCaretAtPoint(layout, 0, 0)?.charIndex, getSelectionRects(layout, 0, 1));
  const labels = new BatchedText({ pixels: true, sprites: true });
  labels.addLabel({ text: 'Here', position: [1, 2, 3] }).visible = false;
  text.dispose();
}

// @ts-expect-error there is no such anchor
export const wrongAnchor = <VectorText textAlign="middle">x</VectorText>;
// @ts-expect-error there is no such mode
export const wrongMode = <VectorMaterial src={logo} mode="glow" />;
// @ts-expect-error there is no such option
export const wrongOption = <VectorMask src={logo} colour="red" />;

useVectorTexture.preload([logo, map]);
useVectorTexture.clear(logo);

export async function withoutReact(bytes: Bytes, onProgress: OnProgress, source: LiveOptions): Promise<void> {
  const loader = new vexture.VectorTextureLoader();
  const texture: AnyVectorTexture = await loader.setPath('/textures/').loadAsync(logo, onProgress);
  const live = await vexture.LiveVectorTexture.connect('/shapes/logo', source);
  const fold: vexture.FoldTexture = await new vexture.FoldLoader().loadAsync('/logo.fold.ktx2');
  live.addEventListener('note', (event) => console.warn(event.message, event.target.name));
  // @ts-expect-error there is no such event
  live.addEventListener('changed', () => {});
  const note: VectorTextureEvents['note'] = { message: 'unreachable' };
  const parameters: VectorMaterialParameters = { texture, root: 'logo', mode: 'paint', toneMapped: false, fold };
  const material = new vexture.VectorMaterial(parameters);
  material.setValues({ mode: 'cut', threshold: 0.25, color: 'red' });
  [material.mode, material.wrap, material.fold, material.time] = ['paint', 'repeat', null, 2];
  // @ts-expect-error it is one of three
  material.mode = 'glow';
  const mesh: Masked = new Mesh(new PlaneGeometry(), new MeshStandardMaterial());
  const mask = vexture.applyVectorMask(mesh.material as MeshStandardMaterial, texture, options(fold)).attach(mesh);
  [mask.mode, mask.invert, mask.transform] = ['alpha', true, new Matrix3()];
  const found: vexture.VectorMask | undefined = vexture.vectorMaskOf(material);
  const [hit] = new Raycaster().intersectObject(mesh as Mesh);
  const same: MaskedIntersection | undefined = hit;
  const element: FoundElement | null | undefined = hit?.element ?? same?.element ?? found?.elementAt(0.5, 0.5);
  const instances = new InstancedMesh(new PlaneGeometry(), material, 2);
  instances.geometry.setAttribute('vextureRoot', vexture.rootAttribute(live, ['logo', 0]));
  const choice: RootChoice = 'logo';
  live.clone().setPaints({ Delft: 0xcc0000, Leiden: [0, 0.4, 0.8, 1] }, choice);
  const data: PackedData = await vexture.readPacked(bytes);
  const root: Root | undefined = data.roots[0];
  const paint: RootPaint | null | undefined = root?.paint;
  const any: TextureData = texture.data;
  if (root) vexture.paintAt(data, root.quad, 0.5, 0.5);
  if (root) console.log(vexture.cellAt(data, root.quad, 0.5, 0.5), vexture.contains(data, root.quad, 0.5, 0.5));
  if (root) console.log(vexture.bounds(data, root.quad), vexture.counts(data, root.quad));
  console.log(note.message, element?.name, paint?.opacity, any.encoding, new vexture.VextureError('wrong', 'field').field);
}

export async function otherEntries(one: Uint8Array): Promise<void> {
  const thesis: ThesisTexture = await new ThesisLoader().loadAsync(['logo.quads.png', 'logo.curves.png']);
  const data: ThesisData = await readThesis(one, one);
  const foam: Foam = { width: 0.02 };
  const [calm, depths] = [{} as Calm, {} as DepthColors];
  const [mirrored, plain]: [VectorWaterOptions, SimpleWaterOptions] = [{ foam, calm }, { foam, depthColors: depths }];
  const texture = new vexture.VectorTexture(await vexture.readPacked(one));
  vexture.applyVectorMask(new vexture.VectorMaterial(), thesis, { root: null, mode: 'cut' }).texture = texture;
  const bits: 8 | 16 = data.bits;
  const waters = [new VectorWater(new PlaneGeometry(), texture, mirrored), new SimpleWater(new PlaneGeometry(), texture, plain)];
  console.log(bits, waters, chooseWater(), waterNormals(64, 1));
}

/** A model, and a mask of its materials. */
export async function model(texture: vexture.VectorTexture): Promise<void> {
  const { scene } = await new GLTFLoader().register((parser) => new VectorTexturePlugin(parser)).loadAsync('van.glb');
  const options: vexture.SceneMaskOptions = { materials: ({ name }) => name === 'Sign', transform: vexture.gltfTransform() };
  const all = vexture.applyVectorMaskToScene(scene, texture, options);
  all.set({ wrap: 'repeat', root: all.masks[0].root });
  all.remove();
}

/** Maps, and what WebGPURenderer draws. */
export async function tilesAndNodes(texture: vexture.VectorTexture): Promise<void> {
  const layer = new VectorTileLayer({ id: 'parcels', source: 'parcels.pmtiles' });
  layer.setPaint((id) => (id === 'sold' ? 'red' : undefined));
  layer.on('click', ({ feature, lngLat }) => console.log(feature?.id, lngLat.lng));
  const globe = new VectorGlobe({ source: await openTiles('parcels.pmtiles'), radius: 1 });
  const material = new nodes.VectorNodeMaterial({ texture, mode: 'paint', side: 2 });
  // @ts-expect-error there is no such mode
  material.mode = 'glow';
  const title = new nodes.Text({ text: 'Map' });
  console.log(title.layout, globe.attribution, nodes.vectorCoverage(texture, { wrap: 'repeat', root: nodes.instancedRoot() }));
}
