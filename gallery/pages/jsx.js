// A small compiler of JSX, so that the example of React can be edited without a build: elements become calls of
// createElement, on the lines where they were; the rest of the source stays as it is.
globalThis.galleryJsx = (source) => {
  const KEYWORDS = /^(return|case|default|typeof|await|yield|in|of|else)$/;
  let at = 0;

  function fail(message) {
    const line = source.slice(0, at).split('\n').length;
    throw Object.assign(new SyntaxError(message), { line });
  }

  /** What an expression matches here, and go on behind it; null. @param {RegExp} sticky */
  function taken(sticky) {
    sticky.lastIndex = at;
    const found = sticky.exec(source)?.[0];
    if (!found) return null;
    at += found.length;
    return found;
  }

  const blank = () => taken(/(?:\s+|\/\/[^\n]*|\/\*[^]*?\*\/)+/y) ?? '';
  const lines = (text) => '\n'.repeat(text.split('\n').length - 1);

  function template() {
    let out = source[at++];
    while (source[at] !== '`') {
      if (at >= source.length) fail('a template has no end');
      out += taken(/(?:\\[^]|\$(?!\{)|[^`\\$])+/y) ?? '';
      if (taken(/\$\{/y)) out += `\${${braced()}}`;
    }
    return out + source[at++];
  }

  /** The code up to a closing brace, which is left out. */
  function braced() {
    const out = code();
    if (source[at++] !== '}') fail('a { has no }');
    return out;
  }

  function code() {
    let [out, depth, isValue] = ['', 0, false];
    while (at < source.length && (source[at] !== '}' || depth > 0)) {
      const space = blank();
      out += space;
      if (space) continue;
      const word = taken(/[\w$]+/y);
      const text = word ?? taken(/'(?:\\[^]|[^'\\\n])*'|"(?:\\[^]|[^"\\\n])*"/y) ?? (isValue ? null : taken(/\/(?:\\.|\[[^\]\n]*\]|[^/\\\n])+\/\w*/y));
      if (text) [out, isValue] = [out + text, !word || !KEYWORDS.test(word)];
      else if (source[at] === '`') [out, isValue] = [out + template(), true];
      else if (!isValue && /^<[\w$>]/.test(source.slice(at, at + 2))) [out, isValue] = [out + element(), true];
      else {
        const mark = source[at++];
        depth += { '{': 1, '}': -1 }[mark] ?? 0;
        [out, isValue] = [out + mark, /[)\]]/.test(mark)];
      }
    }
    return out;
  }

  function attributes() {
    let out = '{';
    for (;;) {
      out += lines(blank());
      if (/[/>]/.test(source[at])) return `${out}}`;
      if (taken(/\{\s*(?=\.\.\.)/y)) {
        out += `${braced()},`;
        continue;
      }
      const name = taken(/[\w$:-]+/y) ?? fail('an element has no >');
      out += `${JSON.stringify(name)}:${taken(/\s*=\s*/y) ? value() : 'true'},`;
    }
  }

  function value() {
    if (taken(/\{/y)) return `(${braced()})`;
    if (source[at] === '<') return element();
    return taken(/"[^"]*"|'[^']*'/y) ?? fail('an attribute has no value');
  }

  /** As React reads text: without the blanks around line breaks. */
  function shown(text) {
    const parts = text.split(/\s*\n\s*/);
    return parts.filter(Boolean).join(' ');
  }

  function children(name) {
    let out = '';
    while (!taken(/<\//y)) {
      if (at >= source.length) fail(`<${name}> has no </${name}>`);
      const text = taken(/[^<{]+/y);
      if (text) out += (shown(text) ? `,${JSON.stringify(shown(text))}` : '') + lines(text);
      else if (taken(/\{/y)) {
        const inner = braced();
        out += inner.replace(/\/\*[^]*?\*\//g, '').trim() ? `,(${inner})` : lines(inner);
      } else out += `,${element()}`;
    }
    const closed = taken(/[\w$.]+/y) ?? '';
    if (closed !== name || !taken(/\s*>/y)) fail(`<${name}> ends as </${closed}>`);
    return out;
  }

  function element() {
    at++;
    const name = taken(/[\w$.]+/y) ?? '';
    const type = /^[a-z][^.]*$/.test(name) ? JSON.stringify(name) : name || 'galleryFragment';
    const start = `galleryElement(${type},${attributes()}`;
    if (taken(/\/\s*>/y)) return `${start})`;
    if (!taken(/>/y)) fail(`<${name} has no >`);
    return `${start}${children(name)})`;
  }

  const compiled = code();
  if (at < source.length) fail('a } has no {');
  return `import { createElement as galleryElement, Fragment as galleryFragment } from 'react'; ${compiled}`;
};
