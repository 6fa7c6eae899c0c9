/** The bar below the canvas for choosing a step. */
import { element } from '../viewer/dom.js';

const SPEEDS = Object.freeze([0.5, 1, 2, 4]);

/** @param {import('./player.js').Player} player */
export function createTimeBar(player) {
  const button = (/** @type {string} */ label, /** @type {string} */ sign, /** @type {() => void} */ act) =>
    element('button', { type: 'button', 'aria-label': label, title: label, onclick: act }, sign);
  const move = (/** @type {number} */ steps) => {
    player.pause();
    void player.go(player.index + steps);
  };
  const before = button('Previous step', '‹', () => move(-1));
  const play = button('Play', '▶', () => (player.playing ? player.pause() : player.play()));
  const after = button('Next step', '›', () => move(1));
  const slider = element('input', {
    type: 'range', 'aria-label': 'Time', min: 0, max: 0, step: 1, value: 0,
    oninput: () => {
      player.pause();
      void player.go(Number(slider.value));
    },
  });
  const label = element('span', { class: 'when' });
  const speed = element('select', { 'aria-label': 'Speed', title: 'Speed', onchange: () => {
    player.speed = Number(speed.value);
  } });
  for (const value of SPEEDS) {
    speed.append(element('option', { value, selected: value === player.speed }, `${value}×`.replace('0.5', '½')));
  }
  const fade = element('input', { type: 'checkbox', id: 'fade', onchange: () => {
    player.fading = fade.checked;
  } });
  const fading = element('label', { class: 'fading', for: 'fade' }, fade, 'Cross-fade');
  const bar = element('div', { class: 'time', role: 'group', 'aria-label': 'Time' },
    element('div', { class: 'steps' }, before, play, after), label, slider, speed, fading);

  function follow() {
    const { index, count, playing } = player;
    bar.hidden = count < 2;
    slider.max = String(count - 1);
    slider.value = String(index);
    label.textContent = player.step ? player.label(index) : '';
    slider.setAttribute('aria-valuetext', `${label.textContent}, step ${index + 1} of ${count}`);
    before.disabled = index <= 0;
    after.disabled = index >= count - 1;
    const name = playing ? 'Pause' : 'Play';
    play.setAttribute('aria-label', name);
    play.title = name;
    play.textContent = playing ? '❚❚' : '▶';
  }

  for (const kind of ['step', 'steps', 'play']) player.addEventListener(kind, follow);
  follow();
  return bar;
}
