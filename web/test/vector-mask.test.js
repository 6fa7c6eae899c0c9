import { BoxGeometry, BufferGeometry, Color, InstancedMesh, Matrix3, Mesh, MeshBasicMaterial, MeshDepthMaterial, PlaneGeometry, ShaderLib, Texture } from 'three';
import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import { VextureError } from '../src/errors.js';
import { readPacked } from '../src/packed.js';
import { texts } from '../src/mask-shader.js';
import { rootAttribute } from '../src/attributes.js';
import { applyVectorMask, vectorMaskOf } from '../src/vector-mask.js';
import { VectorMaterial } from '../src/vector-material.js';
import { VectorTexture } from '../src/vector-texture.js';
import { fixture } from './files.js';

const read = async (/** @type {string} */ name) => new VectorTexture(await readPacked(fixture(`${name}.ktx2`), name));
const [duck, badge, drawings] = await Promise.all([read('duck'), read('badge'), read('drawings')]);
const other = drawings.roots[1].name;

/** Call what three.js calls before it draws a mesh. @param {Mesh<BufferGeometry, import('three').Material>} mesh */
function announce(mesh) {
  const unread = /** @type {any} */ (null);
  mesh.material.onBeforeRender(unread, unread, unread, mesh.geometry, mesh, unread);
}

describe('several changes at once', () => {
  test('a texture and a shape of it, which neither goes with the old ones', () => {
    const mask = applyVectorMask(new MeshBasicMaterial(), duck, { root: duck.roots[0].name });
    expect(() => (mask.root = other)).toThrow(VextureError);
    expect(() => (mask.texture = drawings)).toThrow(VextureError);
    expect([mask.texture, mask.root]).toEqual([duck, duck.roots[0].name]);
    mask.set({ texture: drawings, root: other });
    expect([mask.texture, mask.root]).toEqual([drawings, other]);
  });

  test('all or nothing', () => {
    const mask = applyVectorMask(new MeshBasicMaterial(), duck, { wrap: 'repeat' });
    expect(() => mask.set({ texture: drawings, wrap: 'clamp', root: 'nobody' })).toThrow(VextureError);
    expect([mask.texture, mask.root, mask.wrap]).toEqual([duck, undefined, 'repeat']);
  });

  test('a material of its own', () => {
    const material = new VectorMaterial({ texture: duck, root: 0 });
    material.mask?.set({ texture: drawings, root: other });
    expect([material.texture, material.root]).toEqual([drawings, other]);
    expect(material.clone().root).toBe(other);
  });
});

describe('a clone', () => {
  test('has a mask of its own, with the same options', () => {
    const material = new MeshBasicMaterial({ color: 0x123456 });
    const mask = applyVectorMask(material, drawings, { root: other, wrap: 'repeat', mode: 'alpha', transform: new Matrix3() });
    const copy = material.clone();
    const copied = vectorMaskOf(copy);
    expect(copied).not.toBe(mask);
    expect(copied?.options).toEqual(mask.options);
    expect(copied?.transform).not.toBe(mask.transform);
    expect([copied?.texture, copied?.material]).toEqual([drawings, copy]);
    expect([copy.transparent, copy.color.getHex()]).toEqual([true, 0x123456]);
    expect(copy.customProgramCacheKey()).toBe(material.customProgramCacheKey());
    copied?.set({ wrap: 'clamp' });
    expect(mask.wrap).toBe('repeat');
    copied?.remove();
    expect([copy.transparent, vectorMaskOf(copy), vectorMaskOf(material)]).toEqual([false, undefined, mask]);
  });

  test('of a clone has one, and of a material whose mask was removed none', () => {
    const material = new MeshBasicMaterial();
    const mask = applyVectorMask(material, duck);
    expect(vectorMaskOf(material.clone().clone())?.texture).toBe(duck);
    mask.remove();
    expect(material.clone).toBe(MeshBasicMaterial.prototype.clone);
    expect(vectorMaskOf(material.clone())).toBeUndefined();
  });

  test('of a material of our own has one mask', () => {
    const copy = new VectorMaterial({ texture: drawings, root: other }).clone();
    expect(vectorMaskOf(copy)).toBe(copy.mask);
  });
});

describe('without a root', () => {
  test('the only shape or the only drawing is shown', () => {
    expect(applyVectorMask(new MeshBasicMaterial(), duck).hits(0.5, 0.5)).toBe(true);
    const painted = new VectorMaterial({ texture: badge, mode: 'paint' });
    expect(painted.mask?.hits(0.5, 0.5)).toBe(badge.roots.some((_, place) => badge.contains(0.5, 0.5, place)));
  });

  test.each(/** @type {const} */ (['alpha', 'cut', 'mix']))('mode %s refuses several shapes', (mode) => {
    const names = badge.roots.map(({ name }) => name).join(', ');
    const message = `badge holds 3 shapes (${names}); choose one by root, or use mode: 'paint'`;
    expect(() => applyVectorMask(new MeshBasicMaterial(), badge, { mode })).toThrow(message);
    expect(() => applyVectorMask(new MeshBasicMaterial(), badge, { mode, root: null })).toThrow(message);
    const mask = applyVectorMask(new MeshBasicMaterial(), duck, { root: 0 });
    if (mode !== 'mix') expect(() => new VectorMaterial({ texture: badge, mode })).toThrow(message);
    expect(() => mask.set({ texture: badge, root: null })).toThrow(message);
    expect(mask.texture).toBe(duck);
  });

  test('mode paint refuses several drawings', () => {
    const message = 'drawings holds 2 drawings (badge, flag); choose one by root';
    expect(() => new VectorMaterial({ texture: drawings, mode: 'paint' })).toThrow(message);
    expect(new VectorMaterial({ texture: drawings, mode: 'paint', root: 'flag' }).root).toBe('flag');
  });

  test('instances have their own', () => {
    const material = new MeshBasicMaterial();
    const mask = applyVectorMask(material, drawings, { instanced: true });
    expect(() => mask.hits(0.5, 0.5)).toThrow('choose one by root');
    for (const root of drawings.roots.keys()) expect(mask.hits(0.5, 0.5, root)).toBe(drawings.contains(0.5, 0.5, root));
  });
});

test.each(['channel', 'mapping', 'matrix', 'colorSpace', 'isCubeTexture'])('a texture with shapes is no image: %s', (property) => {
  expect(() => /** @type {any} */ (duck)[property]).toThrow(/duck: a VectorTexture is no image .* use VectorMaterial, or applyVectorMask/);
  expect(() => ({ ...duck, clone: structuredClone({ duck: duck.name }) })).not.toThrow();
});

describe('a material without a mode', () => {
  const programOf = (/** @type {VectorMaterial} */ material) => material.customProgramCacheKey();
  const painted = programOf(new VectorMaterial({ texture: badge, mode: 'paint' }));
  const silhouette = programOf(new VectorMaterial({ texture: duck, mode: 'alpha' }));

  test('shows a drawing in its colours, and what has none in its own', () => {
    expect(programOf(new VectorMaterial({ texture: badge }))).toBe(painted);
    expect(programOf(new VectorMaterial({ texture: duck }))).toBe(silhouette);
    expect(programOf(new VectorMaterial({ texture: badge, mode: undefined }).clone())).toBe(painted);
  });

  test('shows a shape in the colour that it is given, also later', () => {
    expect(programOf(new VectorMaterial({ texture: badge, root: 0, color: 'white' }))).toBe(silhouette);
    const material = new VectorMaterial({ texture: badge, root: 0 });
    material.color.set('red');
    expect(programOf(material)).toBe(painted);
    announce(new Mesh(new PlaneGeometry(), material));
    expect(programOf(material)).toBe(silhouette);
    expect(new VectorMaterial({ texture: badge, color: 'red', mode: 'paint' }).mode).toBe('paint');
  });

  test('inverts a silhouette', () => {
    expect(new VectorMaterial({ texture: badge, root: 0, invert: true }).mask?.hits(0, 0)).toBe(true);
  });
});

describe('a material without its texture', () => {
  test('has it again as it was', () => {
    const material = new VectorMaterial({ texture: drawings, root: 1 });
    if (material.mask) material.mask.wrap = 'repeat';
    expect(() => (material.root = 'nobody')).toThrow(VextureError);
    material.texture = null;
    material.texture = drawings;
    expect([material.root, material.mask?.wrap]).toEqual([1, 'repeat']);
  });
});

describe('options of a VectorMaterial that are set later', () => {
  const fold = /** @type {any} */ ({ isFoldTexture: true, clock: (/** @type {number} */ time) => time, glsl: 'fold' });
  const values = /** @type {const} */ ({
    root: other, transform: new Matrix3().makeScale(2, 2), mode: 'cut', wrap: 'repeat', flat: true, invert: true,
    threshold: 0.25, background: 'own', instanced: true, fold, time: 3, linear: true, channel: 1,
  });
  const seen = (/** @type {any} */ material) => Object.fromEntries(Object.keys(values).map((name) => [name, material[name]]));

  test('are those of the constructor, before and after there is a texture', () => {
    const made = new VectorMaterial({ texture: drawings, ...values });
    const plain = seen(new VectorMaterial());
    const [early, late] = [new VectorMaterial(), new VectorMaterial({ texture: drawings, root: 0 })];
    for (const material of [early, late]) for (const [name, value] of Object.entries(values)) {
      expect(plain[name]).not.toEqual(value); // so each is seen to change
      Object.assign(material, { [name]: value });
    }
    early.texture = drawings;
    for (const material of [early, late]) {
      expect(seen(material)).toEqual(values);
      expect(material.mask?.options).toEqual(made.mask?.options);
      expect(material.customProgramCacheKey()).toBe(made.customProgramCacheKey());
    }
  });

  test('all options of a mask are options of the material, but what three.js has by that name', () => {
    const { color, map, ...options } = applyVectorMask(new MeshBasicMaterial(), duck).options;
    expect(Object.keys(options).sort()).toEqual(Object.keys(values).sort());
    expect(new VectorMaterial({ color: 0xff0000 }).color).toBeInstanceOf(Color);
  });

  test('change together or not at all, and undefined is the default', () => {
    const material = new VectorMaterial({ texture: badge, mode: 'paint', color: 0x123456 });
    expect(() => (material.mode = 'alpha')).toThrow('choose one by root');
    material.setValues({ mode: 'alpha', root: 1, invert: true, color: 0xff0000 });
    expect([material.mode, material.root, material.color.getHex()]).toEqual(['alpha', 1, 0xff0000]);
    expect(() => material.setValues({ wrap: 'clamp', root: 'nobody' })).toThrow(VextureError);
    expect(() => material.setValues({ texture: undefined })).toThrow(VextureError);
    expect(() => material.setValues(/** @type {any} */ ({ colour: 1 }))).toThrow(/no option "colour"/);
    expect(material.wrap).toBe('none');
    material.setValues({ texture: duck, root: undefined, background: undefined, invert: undefined });
    expect([material.texture, material.root, material.background, material.invert]).toEqual([duck, undefined, 'none', false]);
  });

  test('are refused without a texture, too', () => {
    const material = new VectorMaterial();
    expect(() => Object.assign(material, { mode: 'alfa' })).toThrow(VextureError);
    expect(material.mode).toBe(null);
  });

  test('what stays as it is costs no program, nor does the time', () => {
    const material = new VectorMaterial({ texture: duck, time: 1 });
    const mesh = new Mesh(undefined, material);
    material.mask?.attach(mesh);
    const versions = () => [material.version, mesh.customDepthMaterial?.version];
    const before = versions();
    material.setValues({ texture: duck, mode: null, wrap: 'none', time: 2 });
    expect([...versions(), material.time]).toEqual([...before, 2]);
    expect(() => (material.time = NaN)).toThrow(VextureError);
  });
});

test('flat views have a program of their own, but for a fold', () => {
  const variant = (/** @type {string} */ fold, flat = true) => /** @type {any} */ ({ maps: 'none', wrap: 'none', uv: 'uv', flat, fold });
  expect(texts(variant('')).fragmentDeclare).toContain('#define VEXTURE_FLAT 1\n');
  expect(texts(variant('', false)).fragmentDeclare).not.toContain('#define VEXTURE_FLAT 1\n');
  expect(texts(variant('fold')).fragmentDeclare).not.toContain('#define VEXTURE_FLAT 1\n');
  const material = new VectorMaterial({ texture: duck, flat: true });
  const before = material.customProgramCacheKey();
  if (material.mask) material.mask.flat = false;
  expect(material.customProgramCacheKey()).not.toBe(before);
});

test('colour and map inside are as they are when a picture is drawn', () => {
  const [material, map, color] = [new MeshBasicMaterial(), new Texture(), new Color(0xff0000)];
  const mask = applyVectorMask(material, duck, { mode: 'mix', map, color });
  const program = { ...ShaderLib.basic, uniforms: /** @type {Record<string, {value: any}>} */ ({}) };
  material.onBeforeCompile(/** @type {any} */ (program), /** @type {any} */ (null));
  map.offset.set(0.25, 0.5);
  color.set(0x00ff00);
  expect(program.uniforms.vextureMapTransform.value.elements.slice(6, 8)).toEqual([0.25, 0.5]);
  expect(program.uniforms.vextureInside.value).toBe(color);
  mask.color = 0x0000ff;
  expect(program.uniforms.vextureInside.value.getHex()).toBe(0x0000ff);
});

describe("a material's own shader", () => {
  const source = () => ({ ...ShaderLib.basic, uniforms: {} });
  /** @param {import('three').Material} material @param {any} program */
  const compile = (material, program = source()) => {
    material.onBeforeCompile(program, /** @type {any} */ (null));
    return program;
  };
  const isMasked = (/** @type {any} */ program) => program.fragmentShader.split('uniform uint vextureRootQuad').length - 1;
  const tint = (/** @type {any} */ program) => void (program.fragmentShader += '\n// tinted');

  test('may be set after the mask, alone or with what was there', () => {
    const material = new VectorMaterial({ texture: duck });
    const plain = material.customProgramCacheKey();
    material.onBeforeCompile = tint;
    const replaced = compile(material);
    expect([isMasked(replaced), replaced.fragmentShader.endsWith('tinted')]).toEqual([1, true]);
    const { onBeforeCompile } = material;
    material.onBeforeCompile = (...all) => {
      onBeforeCompile.apply(material, all);
      tint(all[0]);
    };
    const chained = compile(material);
    expect([isMasked(chained), chained.fragmentShader.split('// tinted').length]).toEqual([1, 3]);
    expect(material.customProgramCacheKey()).not.toBe(plain);
  });

  test('has keys of its own, and those of the mask', () => {
    const [one, two] = [duck, badge].map((texture) => new VectorMaterial({ texture }));
    for (const material of [one, two]) material.customProgramCacheKey = () => 'mine';
    expect(one.customProgramCacheKey()).toMatch(/^mine /);
    expect(one.customProgramCacheKey()).not.toBe(two.customProgramCacheKey());
    two.onBeforeCompile = tint;
    expect(two.customProgramCacheKey()).toMatch(/^mine /);
  });

  test('stays when the mask is removed', () => {
    const material = new MeshBasicMaterial();
    const mask = applyVectorMask(material, duck);
    const { onBeforeCompile } = material;
    material.onBeforeCompile = tint;
    mask.remove();
    expect(material.onBeforeCompile).toBe(tint);
    expect(material.customProgramCacheKey()).toBe(String(tint));
    const program = compile(material);
    onBeforeCompile.call(material, program, /** @type {any} */ (null));
    expect(isMasked(program)).toBe(0);
  });
});

describe('what would be drawn as nothing is said in the console', () => {
  /** @type {string[]} */
  let said;
  beforeEach(() => {
    said = [];
    vi.spyOn(console, 'warn').mockImplementation((message) => void said.push(message));
  });
  afterEach(() => vi.restoreAllMocks());

  test('a geometry without texture coordinates, once', () => {
    const mesh = new Mesh(new PlaneGeometry(), new VectorMaterial({ texture: duck }));
    announce(mesh);
    expect(said).toEqual([]);
    const bare = new Mesh(new BufferGeometry(), mesh.material);
    bare.name = 'wall';
    announce(bare);
    announce(bare);
    expect(said).toEqual([expect.stringMatching(/^vexture: wall has no attribute uv; give it texture coordinates/)]);
    mesh.material.channel = 1;
    announce(mesh);
    expect(said[1]).toMatch(/has no attribute uv1; .*channel/);
  });

  test('instances without shapes, or with too few', () => {
    const mesh = new InstancedMesh(new PlaneGeometry(), new VectorMaterial({ texture: drawings, instanced: true }), 3);
    announce(mesh);
    mesh.geometry = new PlaneGeometry();
    mesh.geometry.setAttribute('vextureRoot', rootAttribute(drawings, [0, other]));
    announce(mesh);
    mesh.geometry = new PlaneGeometry();
    mesh.geometry.setAttribute('vextureRoot', rootAttribute(drawings, [0, other, 0]));
    announce(mesh);
    expect(said).toHaveLength(2);
    for (const one of said) expect(one).toMatch(/no attribute vextureRoot of 3 instances; make it by rootAttribute\(/);
  });

  test('JSON, which has no mask', () => {
    const material = new VectorMaterial({ texture: duck, name: 'logo' });
    const { materials } = new Mesh(new BoxGeometry(), material).toJSON();
    expect(materials).toHaveLength(1);
    expect(said).toEqual([expect.stringMatching(/^vexture: the JSON of logo is without its vector texture; mask it again/)]);
    material.texture = null;
    material.toJSON();
    expect(said).toHaveLength(1);
  });
});

describe('what a mask cannot be', () => {
  /** @type {[Record<string, unknown>, string][]} */
  const wrong = [
    [{ mode: 'alfa' }, 'mode'],
    [{ threshold: NaN }, 'threshold'],
    [{ threshold: 2 }, 'threshold'],
    [{ transform: [1, 2] }, 'transform'],
    [{ transform: null }, 'transform'],
    [{ colour: 0xff0000 }, 'an option'],
    [{ mode: 'paint', invert: true }, 'invert'],
    [{ root: 7 }, 'root'],
  ];
  test.each(wrong)('%j', (options, field) => {
    const material = new MeshBasicMaterial();
    const error = (() => {
      try {
        return applyVectorMask(material, duck, /** @type {any} */ (options));
      } catch (refused) {
        return refused;
      }
    })();
    expect(error).toBeInstanceOf(VextureError);
    expect(error).toMatchObject({ field });
    expect(applyVectorMask(material, duck, { transform: new Matrix3() }).mode).toBe('alpha');
  });

  /** @type {[Record<string, unknown>, string][]} */
  const wrongMaterial = [
    [{ colour: 1 }, 'colour'],
    [{ texture: duck, colour: 1 }, 'colour'],
    [{ texture: undefined }, 'texture'],
    [{ texture: duck, mode: 'alfa' }, 'mode'],
  ];
  test.each(wrongMaterial)('a VectorMaterial of %j', (options, field) => {
    const error = (() => {
      try {
        return new VectorMaterial(/** @type {any} */ (options));
      } catch (refused) {
        return refused;
      }
    })();
    expect(error).toBeInstanceOf(VextureError);
    expect(error).toMatchObject({ field });
    expect(new VectorMaterial({ texture: null, color: 0xff0000, side: 2 }).color.getHex()).toBe(0xff0000);
  });

  test.each([undefined, null, new Mesh(), [new MeshBasicMaterial()]])('on what is no material', (/** @type {any} */ material) => {
    expect(() => applyVectorMask(material, duck)).toThrow(/^the material is .*; give one, such as mesh.material$/);
  });

  test('shapes that are no list, and a root that is no name', () => {
    for (const roots of [undefined, 'duck']) {
      expect(() => rootAttribute(duck, /** @type {any} */ (roots))).toThrow(/^roots is .*; give an array of names$/);
    }
    expect(() => new VectorMaterial({ texture: drawings, root: /** @type {any} */ ({}) })).toThrow(/no root {}; near names/);
  });

  test.each([undefined, null, new Texture(), {}])('a mask of %j', (texture) => {
    expect(() => applyVectorMask(new MeshBasicMaterial(), /** @type {any} */ (texture))).toThrow(VextureError);
  });

  test('attached to a mesh of another material', () => {
    const [mask, mesh] = [applyVectorMask(new MeshBasicMaterial(), duck), new Mesh()];
    expect(() => mask.attach(mesh)).toThrow(/another material/);
    mesh.material = mask.material;
    expect(mask.attach(mesh)).toBe(mask);
  });

  test('of instances that say no root', () => {
    const material = new MeshBasicMaterial();
    const [mask, mesh] = [applyVectorMask(material, drawings, { instanced: true }), new Mesh(undefined, material)];
    expect(() => mask.attach(mesh)).toThrow(/rootAttribute/);
    mesh.geometry.setAttribute('vextureRoot', rootAttribute(drawings, [other, 0]));
    expect(mask.attach(mesh)).toBe(mask);
  });

  test('colours where there are none', () => {
    expect(() => applyVectorMask(new MeshDepthMaterial(), duck, { mode: 'mix' })).toThrow(/MeshDepthMaterial/);
  });
});
