import { describe, expect, test } from 'vitest';
import { mediaOf } from '../src/convert/cascade.js';
import * as engine from '../src/convert/cascade-engine.js';
import { Pace, atOnce } from '../src/convert/pace.js';

/** @param {string} inner @param {string} [attributes] of the outermost element */
const openSvg = (text) => atOnce(engine.openSvg(text, new Pace()));
const open = (inner, attributes = '') => openSvg(`<svg xmlns="http://www.w3.org/2000/svg" ${attributes}>${inner}</svg>`);
const styleOf = (engine, id) => engine.style(engine.target(`#${id}`));

describe('styles without a browser', () => {
  test('attributes, rules by specificity and order, the attribute style, importance', () => {
    const sheet = '.a{fill:green} #x.b:not(.z){stroke:pink} path,rect{stroke:red;stroke-width:3px;opacity:banana} .a{clip-rule:evenodd!important}';
    const style = styleOf(open(`<style>${sheet}</style><path id="x" class="a b" fill="red" style="stroke-width:5px;clip-rule:nonzero"/>`), 'x');
    expect(['fill', 'stroke', 'stroke-width', 'clip-rule', 'opacity'].map((name) => style.get(name))).toEqual(['green', 'pink', '5px', 'evenodd', '1']);
  });

  test('what is inherited, and what is not', () => {
    const engine = open('<g color="blue" opacity=".5" style="--c: #123"><path id="x"/><path id="y" stroke="currentColor" opacity="inherit"/></g>', 'fill="red"');
    const [x, y] = ['x', 'y'].map((id) => styleOf(engine, id));
    expect([x.get('fill'), x.get('opacity'), y.get('stroke'), y.opacity('opacity')]).toEqual(['red', '1', 'blue', 0.5]);
  });

  test('variables, with fallbacks and without end', () => {
    const engine = open('<g style="--a: var(--b, lime); --c: var(--d); --d: var(--c)"><path id="x" style="fill: var(--a)"/><path id="y" style="fill: var(--c, red)"/></g>');
    expect(styleOf(engine, 'x').get('fill')).toBe('lime');
    expect(styleOf(engine, 'y').get('fill')).toBe('red');
  });

  test('an instance inherits from its use, and is matched where it stands', () => {
    const engine = open('<style>defs path{stroke:red}</style><defs><path id="p"/></defs><use id="u" href="#p" fill="lime"/>');
    const copy = engine.instance(engine.target('#u'), engine.target('#p'));
    expect([engine.style(copy).get('fill'), engine.style(copy).get('stroke')]).toEqual(['lime', 'red']);
  });

  test('lengths of fonts', () => {
    const engine = open('<g font-size="20"><path id="x" stroke-width="2em" style="font-size: 50%"/></g>', 'font-size="10"');
    expect(styleOf(engine, 'x').fontSize).toBe(10);
    expect(styleOf(engine, 'x').get('stroke-width')).toBe('20px');
  });

  test('colours of all notations', () => {
    const engine = open('');
    expect(engine.color('#f00')).toEqual([1, 0, 0, 1]);
    expect(engine.color('rgb(0 255 0 / 50%)')).toEqual([0, 1, 0, 0.5]);
    expect(engine.color('hsl(240 100% 50%)').map((part) => Math.round(1e6 * part) / 1e6)).toEqual([0, 0, 1, 1]);
    expect(engine.color('nonsense')).toBeNull();
  });

  test('media of a light screen', () => {
    expect(['screen', 'print', 'not print', '(prefers-color-scheme: dark)', 'screen and (prefers-color-scheme: light)', 'print, all'].map(mediaOf))
      .toEqual([true, false, true, false, true, true]);
    expect(mediaOf('(min-width: 3px)')).toBeNull();
  });

  test('what runs or moves is left out and noted', () => {
    const engine = open('<script>alert(1)</script><path onclick="x()"><animate attributeName="d"/></path><style>@import "x.css";</style>');
    expect(Object.fromEntries(engine.stripped)).toEqual({ '@import': 1, script: 2, animation: 1 });
    expect(engine.children(engine.root).map((one) => engine.name(one))).toEqual(['path', 'style']);
  });

  test.each([
    ['<svg', 'not well-formed XML'],
    ['', 'not well-formed XML: it does not begin with <'],
    ['<html xmlns="http://www.w3.org/1999/xhtml"/>', 'the root element is <html>, not <svg>'],
    ['<!DOCTYPE svg [<!ENTITY a SYSTEM "file:///etc/passwd">]><svg xmlns="http://www.w3.org/2000/svg">&a;</svg>', "Entity 'a' is external"],
  ])('refuses %s', (text, message) => {
    expect(() => openSvg(text)).toThrow(message);
  });

  test('replaces entities, also those that hold markup', () => {
    const engine = openSvg('<!DOCTYPE svg [<!ENTITY f "lime"><!ENTITY p "<path id=\'x\' fill=\'&f;\'/>">]><svg xmlns="http://www.w3.org/2000/svg">&p;</svg>');
    expect(styleOf(engine, 'x').get('fill')).toBe('lime');
  });
});
