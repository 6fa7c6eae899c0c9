// What the examples share; copy this file with an example. Above all sliders, switches, choices and colours over a picture:
// native inputs, each with its label.
//
//   const panel = addPanel();
//   panel.slider('Foam', { min: 0, max: 40, value: 20, unit: 'm' }, (metres) => (water.foam = { width: metres / WIDTH }));
//
// Each of them calls its function at once with the first value, and again when the visitor changes it. Setting the `value`
// of what a call returns shows another one, and calls nothing.

const STYLE = `
.controls { position: fixed; left: .75rem; top: .75rem; width: 16rem; max-height: calc(100% - 1.5rem); overflow: auto; box-sizing: border-box;
  border-radius: .6rem; background: #fffffff0; color: #1c2733; accent-color: #0b5cad; font: 14px/1.35 system-ui, sans-serif; box-shadow: 0 1px 6px #0004; }
.controls summary { padding: .45rem .8rem; cursor: pointer; font-weight: 600; user-select: none; }
.controls label, .controls p { display: grid; grid-template-columns: 5.6rem 1fr auto; gap: .5rem; align-items: center; margin: 0; padding: .15rem .8rem; min-height: 1.9rem; box-sizing: border-box; }
.controls p { display: block; min-height: 1.4em; }
.controls > :last-child { margin-bottom: .45rem; }
.controls input[type=range], .controls select { width: 100%; min-width: 0; margin: 0; font: inherit; }
.controls input[type=checkbox] { width: 1.2rem; height: 1.2rem; margin: 0; }
.controls input[type=color] { width: 100%; height: 1.6rem; padding: 0; border: 1px solid #0003; border-radius: .3rem; background: none; }
.controls button { margin: .2rem 0 .2rem .8rem; padding: .3rem .9rem; font: inherit; color: inherit; background: #fff; border: 1px solid #0004; border-radius: .4rem; cursor: pointer; }
.controls label output { min-width: 3.2rem; text-align: right; font-variant-numeric: tabular-nums; }
.controls .legend { display: flex; flex-wrap: wrap; gap: .1rem .7rem; }
.controls .legend i { display: inline-block; width: .9rem; height: .9rem; margin-right: .3rem; vertical-align: -.1rem; border-radius: .15rem; }
@media (max-width: 30rem) {
  .controls { left: .5rem; right: .5rem; top: auto; bottom: .5rem; width: auto; max-height: 45%; }
  .controls label { min-height: 2.4rem; }
}`;
document.head.append(Object.assign(document.createElement('style'), { textContent: STYLE }));

/** Whether this visitor has nothing against movement. */
export const moves = !matchMedia('(prefers-reduced-motion: reduce)').matches;

const isNarrow = matchMedia('(max-width: 30rem)');

/** Let a renderer and its camera fill the window, from now on. On a phone the middle of the view is above the panel. */
export function fillWindow(renderer, camera) {
  const panel = document.querySelector('.controls');
  function fit() {
    const covered = panel && isNarrow.matches ? panel.offsetHeight : 0;
    renderer.setSize(innerWidth, innerHeight);
    camera.setViewOffset(innerWidth, innerHeight, 0, covered / 2, innerWidth, innerHeight);
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
  const panel = element('details', { className: 'controls', open: true }, element('summary', { textContent: title }));
  document.body.append(panel);

  /** A labelled input: `read` gets its value, `write` shows one, `change` takes it; and what shows it in words, if anything. */
  function add(label, input, { read, write, show }, change) {
    const output = element('output');
    input.ariaLabel = label;
    panel.append(element('label', {}, element('span', { textContent: label }), input, ...(show ? [output] : [])));
    function tell() {
      if (show) input.ariaValueText = output.value = show(read());
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
