/** The choice of what the water is coloured by, and its legend. */
import { select } from '../viewer/dom.js';
import { Legend } from './legend.js';
import { readHazard } from './hazard.js';
import { arrivals, greatestDepths, greatestHazards, shadeOf } from './shades.js';
import { classesOf, hazardOf } from './steps.js';

/** @typedef {import('./shades.js').Shade} Shade */

const NAMES = Object.freeze(/** @type {const} */ ([
  ['water', 'Water'], ['depth', 'Depth, in classes'], ['smooth', 'Depth'], ['greatest', 'Greatest depth'],
  ['hazard', 'Greatest hazard'], ['arrival', 'Time of arrival'],
]));

/** @type {Set<string>} */
const OF_SERIES = new Set(['greatest', 'arrival']);
/** Those of all steps. @type {Set<string>} */
const OF_ALL = new Set([...OF_SERIES, 'hazard']);

/** @type {Set<string>} */
const OF_DEPTH = new Set(['depth', 'smooth', 'greatest']);

/** @typedef {{step: import('./steps.js').Step, surface: import('./levels.js').Levels | null}} Known */

/** Hours between two times of the file. @param {string | null | undefined} from @param {string | null | undefined} to */
const hoursBetween = (from, to) => (from && to ? (Date.parse(to) - Date.parse(from)) / 3_600_000 : NaN);

/**
 * @param {import('./stage.js').Stage} stage
 * @param {import('./player.js').Player} player
 * @param {import('./page-data.js').Flood} flood
 * @param {(name: string) => Promise<Known>} levelsAt
 */
export function createShades(stage, player, flood, levelsAt) {
  const legend = new Legend();
  let turn = 0;
  let widest = 0;
  let current = /** @type {ReturnType<typeof shadeOf>} */ (null);

  /** Show the map of the classes of the shown step, if that is how the water is coloured. */
  async function map() {
    const { step } = player;
    const [mine, classes] = [turn, current?.mapped && step ? await classesOf(step) : null];
    if (mine === turn && step === player.step) stage.sea.classes = classes;
    stage.requestFrame();
  }
  let mapping = Promise.resolve();
  player.addEventListener('step', () => {
    mapping = map().catch(failed);
  });

  /** @param {unknown} error */
  const failed = (error) => {
    player.dispatchEvent(new CustomEvent('failed', { detail: error }));
  };

  /** Of all steps: the hours from the first to the last, and when each place was first under water. */
  function arrived(/** @type {Known[]} */ all) {
    const first = all[0].step.manifest.facts?.time;
    const steps = all.flatMap(({ step, surface }) =>
      (surface ? [{ hours: hoursBetween(first, step.manifest.facts?.time), wet: surface.wet }] : []));
    const hours = steps.at(-1)?.hours ?? NaN;
    if (!(hours > 0)) throw new Error('The steps have no times, so it is not known when the water came.');
    return { hours, values: arrivals(steps, stage.surface.relief) };
  }

  /** Of all steps whose speeds are known. */
  async function endangered(/** @type {Known[]} */ all) {
    const { relief } = stage.surface;
    const found = await Promise.all(all.map(({ step }) => hazardOf(step)));
    const ratings = found.flatMap((one) => (one ? [readHazard(one.png, one.facts, relief)] : []));
    if (ratings.length === 0) throw new Error('No step has speeds of the water, so its hazard is not known.');
    return { hours: 0, values: greatestHazards(ratings, relief.columns) };
  }

  /** What the colours are of, if not of the depth now. @param {string} shade */
  async function valuesOf(shade) {
    if (!OF_ALL.has(shade)) return { hours: 0, values: null };
    const all = await Promise.all(player.names.map(levelsAt));
    const areas = all.map(({ step }) => step.manifest.facts?.area ?? 0);
    widest = areas.indexOf(Math.max(...areas));
    if (shade === 'arrival') return arrived(all);
    if (shade === 'hazard') return endangered(all);
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
      offer();
      void chosen('water');
    }
  };
  const picked = async (/** @type {string} */ value) => {
    await chosen(value);
    if (!OF_ALL.has(value) || list.value !== value) return;
    player.pause();
    await player.go(widest); // what is of all times is seen where the water is
  };
  const { row, list } = select('Colours', NAMES, picked);
  /** Whether the shown step, or the only one, has no such values. @param {string} value */
  function isWithout(value) {
    const { views, facts } = player.step?.manifest ?? {};
    if (value === 'hazard') return !views?.hazard;
    if (OF_SERIES.has(value) && player.count < 2) return true;
    if (!OF_DEPTH.has(value) || !player.step) return false;
    if (facts?.ranges) return value !== 'depth'; // the classes are known, and no depths
    return !facts?.depth && stage.surface.relief.invented; // the depth would be one of invented ground
  }
  const offer = () => {
    for (const option of list.options) {
      const { value } = option;
      const without = isWithout(value);
      option.hidden = option.disabled = without && value !== list.value;
    }
  };
  player.addEventListener('steps', () => {
    offer();
    if (OF_ALL.has(list.value)) void chosen(list.value);
  });
  player.addEventListener('step', offer);
  offer();
  return {
    row,
    legend: legend.element,
    get shade() {
      return current;
    },
    /** Whether what is shown is of all times. */
    get isOfAll() {
      return OF_ALL.has(list.value);
    },
    get value() {
      return list.value;
    },
    /** That can be chosen now. */
    get offered() {
      return [...list.options].filter(({ disabled }) => !disabled).map(({ value }) => value);
    },
    /** Until the shown step is coloured. */
    settled: () => mapping,
    /** Those that are not offered change nothing. @param {string} value */
    choose(value) {
      if (!this.offered.includes(value)) return Promise.resolve();
      list.value = value;
      return chosen(value);
    },
  };
}
