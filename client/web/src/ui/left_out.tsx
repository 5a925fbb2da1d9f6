// Tells where a page shows a part only.

import {count} from '../model/numbers';

/** How many are shown, if not all are; `way` tells where the others are. */
export function LeftOut({shown, all, what, way = ''}: {shown: number; all: number; what: string; way?: string}) {
  if (shown >= all) return null;
  return <span class="soft left-out">{count(shown)} of {count(all)} {what} shown{way && `; ${way}`}</span>;
}
