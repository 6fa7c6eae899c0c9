// What the examples share; copy this file with an example. Above all sliders, switches, choices and colours over a picture:
// native inputs, each with its label.
//
//   const panel = addPanel();
//   panel.slider('Foam', { min: 0, max: 40, value: 20, unit: 'm' }, (metres) => (water.foam = { width: metres / WIDTH }));
//
// Each of them calls its function at once with the first value, and again when the visitor changes it. Setting the `value`
// of what a call returns shows another one, and calls nothing.

const STYLE = `
.controls { position: fixed; inset: auto .5rem .5rem; max-height: 50%; overflow: auto; box-sizing: border-box; border-radius: .6rem; padding: 0 .8rem;
  background: #fffffff2; color: #1c2733; accent-color: #0b5cad; font: 14px/1.35 system-ui, sans-serif; box-shadow: 0 1px 6px #0004; }
.controls summary { padding: .4rem 0; cursor: pointer; font-weight: 600; user-select: none; }
.controls > div { display: flex; flex-wrap: wrap; align-items: center; gap: 0 1.4rem; padding-bottom: .3rem; }
.controls label { flex: 1 1 15rem; display: flex; gap: .6rem; align-items: center; min-height: 38px; }
.controls label:has(input[type=checkbox], input[type=color]) { flex: 0 1 auto; }
.controls label > span:first-child { flex: none; min-width: 3.4rem; }
.controls label:has(input[type=checkbox], input[type=color]) > span:first-child { min-width: 0; }
.controls p { flex: 1 0 100%; margin: 0; min-height: 1.5em; }
.controls input[type=range], .controls select { flex: 1; min-width: 0; margin: 0; font: inherit; }
.controls select { padding: .2rem; }
.controls input[type=checkbox] { width: 1.3rem; height: 1.3rem; margin: 0; }
.controls input[type=color] { width: 2.6rem; height: 1.7rem; padding: 0; border: 1px solid #0003; border-radius: .3rem; background: none; }
.controls button { padding: .35rem .9rem; font: inherit; color: inherit; background: #fff; border: 1px solid #0004; border-radius: .4rem; cursor: pointer; }
.controls label > .value { flex: none; min-width: 3.3rem; text-align: right; font-variant-numeric: tabular-nums; }
.controls .legend { display: flex; flex-wrap: wrap; gap: .1rem .8rem; }
.controls .legend i { display: inline-block; width: .9rem; height: .9rem; margin-right: .3rem; vertical-align: -.1rem; border-radius: .15rem; border: 1px solid #0003; }`;
document.head.append(Object.assign(document.createElement('style'), { textContent: STYLE }));

/** Whether this visitor has nothing against movement. */
export const moves = !matchMedia('(prefers-reduced-motion: reduce)').matches;

/** Let a renderer and its camera fill the window, from now on; what the camera is to show is above the panel. */
export function fillWindow(renderer, camera) {
  const panel = document.querySelector('.controls');
  function fit() {
    const covered = panel && getComputedStyle(panel).display !== 'none' ? innerHeight - panel.offsetTop : 0;
    renderer.setSize(innerWidth, innerHeight);
    camera.setViewOffset(innerWidth, innerHeight - covered, 0, 0, innerWidth, innerHeight); // and its aspect
  }
  addEventListener('resize', fit);
  panel?.addEventListener('toggle', fit);
  fit();
}

const element = (name, properties = {}, ...parts) => {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...parts);
  return made;
};

/** A panel, open at first, which can be folded. */
export function addPanel(title = 'Controls') {
  const panel = element('div');
  document.body.append(element('details', { className: 'controls', open: true }, element('summary', { textContent: title }), panel));

  /** A labelled input: `read` gets its value, `write` shows one, `change` takes it; and what shows it in words, if anything. */
  function add(label, input, { read, write, show }, change) {
    const output = element('span', { className: 'value', ariaHidden: 'true' }); // it is told by aria-valuetext
    input.ariaLabel = label;
    panel.append(element('label', {}, element('span', { textContent: label }), input, ...(show ? [output] : [])));
    function tell() {
      if (show) input.ariaValueText = output.textContent = show(read());
    }
    input.addEventListener('input', () => {
      tell();
      change(read());
    });
    tell();
    change(read());
    return {
      get value() { return read(); },
      set value(value) {
        write(value);
        tell();
      },
    };
  }

  return {
    /** A slider; its value is shown with a unit, or by a function. */
    slider(label, { min, max, value, step = 'any', unit = '', show = (at) => `${Number(at.toPrecision(3))} ${unit}` }, change = () => {}) {
      const input = element('input', { type: 'range', min, max, step, value });
      return add(label, input, { read: () => input.valueAsNumber, write: (next) => (input.value = next), show }, change);
    },
    toggle(label, isOn, change = () => {}) {
      const input = element('input', { type: 'checkbox', checked: isOn });
      return add(label, input, { read: () => input.checked, write: (next) => (input.checked = next) }, change);
    },
    choice(label, names, change = () => {}) {
      const input = element('select', {}, ...names.map((name) => element('option', { textContent: name })));
      return add(label, input, { read: () => input.value, write: (next) => (input.value = next) }, change);
    },
    color(label, value, change = () => {}) {
      const input = element('input', { type: 'color', value });
      return add(label, input, { read: () => input.value, write: (next) => (input.value = next) }, change);
    },
    button(label, press) {
      panel.append(element('button', { type: 'button', textContent: label, onclick: press }));
    },
    /** A line of text; set its `textContent`. */
    text(first = '') {
      const line = element('p', { role: 'status', textContent: first });
      panel.append(line);
      return line;
    },
    /** A legend; returns what shows another list of colours and their texts. */
    legend(first = []) {
      const row = element('p', { className: 'legend' });
      panel.append(row);
      const show = (list) =>
        row.replaceChildren(...list.map(([color, text]) => {
          const swatch = element('i');
          swatch.style.background = color;
          return element('span', {}, swatch, text);
        }));
      show(first);
      return show;
    },
  };
}
