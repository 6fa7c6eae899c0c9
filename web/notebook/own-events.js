/** Events of what lies above a picture. */

/** What the stage would take for a move of the picture. */
const OWN = ['pointerdown', 'pointermove', 'pointerup', 'wheel', 'keydown', 'dblclick'];

/** Keep the events of an element from the stage below it. @param {HTMLElement} above */
export function keepEvents(above) {
  for (const name of OWN) above.addEventListener(name, (event) => event.stopPropagation());
}
