/** The choice of what the water is coloured by, and its legend. */
import { select } from '../viewer/dom.js';
import { Legend } from './legend.js';
import { arrivals, greatestDepths, shadeOf } from './shades.js';
import { classesOf } from './steps.js';

/** @typedef {import('./shades.js').Shade} Shade */

const NAMES = Object.freeze(/** @type {const} */ ([
  ['water', 'Water'], ['depth', 'Depth, in classes'], ['smooth', 'Depth'], ['greatest', 'Greatest depth'],
  ['arrival', 'Time of arrival'],
]));

/** @type {Set<string>} */
const OF_SERIES = new Set(['greatest', 'arrival']);

/** Hours between two times of the file. @param {string | null | undefined} from @param {string | null | undefined} to */
const hoursBetween = (from, to) => (from && to ? (Date.parse(to) - Date.parse(from)) / 3_600_000 : NaN);

/**
 * @param {import('./stage.js').Stage} stage
 * @param {import('./player.js').Player} player
 * @param {import('./page-data.js').Flood} flood
 * @param {(name: string) => Promise<{step: import('./steps.js').Step, surface: import('./levels.js').Levels | null}>}
 *   levelsAt
 */
export function createShades(stage, player, flood, levelsAt) {
  const legend = new Legend();
  let turn = 0;
  let current = /** @type {ReturnType<typeof shadeOf>} */ (null);

  /** Show the map of the classes of the shown step, if that is how the water is coloured. */
  async function map() {
    const { step } = player;
    const [mine, classes] = [turn, current?.mapped && step ? await classesOf(step) : null];
    if (mine === turn && step === player.step) stage.sea.classes = classes;
    stage.requestFrame();
  }
  player.addEventListener('step', () => void map().catch(failed));

  /** @param {unknown} error */
  const failed = (error) => player.dispatchEvent(new CustomEvent('failed', { detail: error }));

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

  /** What the colours are of, if not of the depth now. @param {string} shade */
  async function valuesOf(shade) {
    if (shade === 'arrival') return arrived();
    if (shade !== 'greatest') return { hours: 0, values: null };
    const all = await Promise.all(player.names.map(levelsAt));
    const { heights } = stage.surface.relief;
    return { hours: 0, values: greatestDepths(all.flatMap(({ surface }) => surface?.levels ?? []), heights) };
  }

  const chosen = async (/** @type {string} */ value) => {
    const mine = ++turn;
    try {
      const { hours, values } = await valuesOf(value);
      if (mine !== turn) return;
      const shade = shadeOf(/** @type {Shade} */ (value), flood, hours);
      stage.sea.color(shade?.colors ?? null, values);
      current = shade;
      legend.show(shade);
      await map();
    } catch (error) {
      failed(error);
      list.value = 'water';
      void chosen('water');
    }
  };
  const { row, list } = select('Colours', NAMES, chosen);
  const ofSeries = [...list.options].filter(({ value }) => OF_SERIES.has(value));
  const follow = () => {
    for (const option of ofSeries) option.hidden = option.disabled = player.count < 2;
    if (OF_SERIES.has(list.value)) void chosen(list.value);
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
