import world from 'playground-map';
import anchor from './anchor.svg';
import balloon from './balloon.svg';

/** Examples, of which the page shows the first when it is opened. */
export default [
  { name: 'Balloon', text: balloon },
  { name: 'Anchor', text: anchor },
  { name: 'World', text: world },
];
