/** The choice of what the water is coloured by, and its legend. */
import { select } from '../viewer/dom.js';
import { Legend } from './legend.js';
import { arrivals, shadeOf } from './shades.js';

/** @typedef {import('./shades.js').Shade} Shade */

const NAMES = Object.freeze(/** @type {const} */ ([
  ['water', 'Water'], ['depth', 'Depth, in classes'], ['smooth', 'Depth'], ['arrival', 'Time of arrival'],
]));

/** Hours between two times of the file. @param {string | null | undefined} from @param {string | null | undefined} to */
const hoursBetween = (from, to) => (from && to ? (Date.parse(to) - Date.parse(from)) / 3_600_000 : NaN);

/**
 * @param {import('./stage.js').Stage} stage
 * @param {import('./player.js').Player} player
 * @param {import('./page-data.js').Flood} flood
 * @param {(name: string) => Promise<{step: import('./steps.js').Step, surface: import('./levels.js').Levels | null}>}
 *   levelsAt
 */
export function createShades(stage, player, { depths }, levelsAt) {
  const legend = new Legend();
  let turn = 0;
  let current = /** @type {ReturnType<typeof shadeOf>} */ (null);

  /** Of all steps: the hours from the first to the last, and when each place was first under water. */
  async function arrived() {
    const all = await Promise.all(player.names.map(levelsAt));
    const first = all[0].step.manifest.facts?.time;
    const steps = all.flatMap(({ step, surface }) =>
      (surface ? [{ hours: hoursBetween(first, step.manifest.facts?.time), wet: surface.wet }] : []));
    const hours = steps.at(-1)?.hours ?? NaN;
    if (!(hours > 0)) throw new Error('The steps have no times, so it is not known when the water came.');
    return { hours, values: arrivals(steps, stage.surface.relief) };
  }

  const chosen = async (/** @type {string} */ value) => {
    const mine = ++turn;
    try {
      const { hours, values } = value === 'arrival' ? await arrived() : { hours: 0, values: null };
      if (mine !== turn) return;
      const shade = shadeOf(/** @type {Shade} */ (value), depths, hours);
      stage.sea.color(shade?.colors ?? null, values);
      current = shade;
      legend.show(shade);
      stage.requestFrame();
    } catch (error) {
      player.dispatchEvent(new CustomEvent('failed', { detail: error }));
      list.value = 'water';
      void chosen('water');
    }
  };
  const { row, list } = select('Colours', NAMES, chosen);
  const arrival = /** @type {HTMLOptionElement} */ ([...list.options].find(({ value }) => value === 'arrival'));
  const follow = () => {
    arrival.hidden = arrival.disabled = player.count < 2;
    if (list.value === 'arrival') void chosen('arrival');
  };
  player.addEventListener('steps', follow);
  follow();
  return {
    row,
    legend: legend.element,
    get shade() {
      return current;
    },
    get value() {
      return list.value;
    },
    choose: (/** @type {string} */ value) => {
      if (![...list.options].some((option) => option.value === value && !option.disabled)) return;
      list.value = value;
      void chosen(value);
    },
  };
}
