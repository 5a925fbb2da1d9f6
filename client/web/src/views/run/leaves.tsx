// Pages of a long table.

import {count} from '../../model/numbers';
import {setQuery} from '../../ui/route';

const LEAF = 100;

/** What of a list a page of a table shows. */
export interface Leaf<T> {
  shown: T[];
  first: number;
  all: number;
}

/** The page of the number that a parameter has; the first one without it. */
export function leafOf<T>(rows: T[], page: string | null): Leaf<T> {
  const last = Math.max(Math.ceil(rows.length / LEAF) - 1, 0);
  const first = LEAF * Math.min(Math.max((Number(page) || 1) - 1, 0), last);
  return {shown: rows.slice(first, first + LEAF), first, all: rows.length};
}

/** Buttons to the pages before and after, if there is more than one. `name` is the parameter. */
export function Leaves({leaf: {first, all}, name, what}: {leaf: Leaf<unknown>; name: string; what: string}) {
  const turn = (to: number) => setQuery({[name]: String(to / LEAF + 1)});
  if (all <= LEAF) return null;
  return (
    <span class="group" role="group" aria-label={`Pages of ${what}`}>
      <button type="button" aria-label="earlier rows" disabled={first === 0} onClick={() => turn(first - LEAF)}>‹</button>
      <span>{count(first + 1)}–{count(Math.min(first + LEAF, all))} of {count(all)}</span>
      <button type="button" aria-label="later rows" disabled={first + LEAF >= all} onClick={() => turn(first + LEAF)}>›</button>
    </span>
  );
}
