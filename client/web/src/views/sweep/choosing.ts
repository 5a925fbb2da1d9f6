// Choosing one of a row of cells by keys.

import type {SweepCell} from '../../api/generated/contact/v1/event_pb';

/** How cells are chosen and run. */
export interface Choosing {
  chosen: number | undefined;
  choose: (cell: number) => void;
  open: (cell: number) => void;
}

/** Arrow keys choose the next cell of a row, Enter runs the one chosen. */
export function keysOver(cells: SweepCell[], {chosen, choose, open}: Choosing) {
  return (event: KeyboardEvent) => {
    if (event.key === 'Enter' && chosen !== undefined) open(chosen);
    const step = {ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1}[event.key];
    if (!step || cells.length === 0) return;
    event.preventDefault();
    const place = cells.findIndex(({index}) => index === chosen);
    choose(cells[Math.min(Math.max(place + step, 0), cells.length - 1)]!.index);
  };
}
