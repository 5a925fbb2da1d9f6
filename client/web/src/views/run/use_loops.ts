// Closer samples for hysteresis. The server thins a series over time so that no peak is lost; of a short cycle that
// leaves a few samples, which are corners of a polygon in its loop. So more are asked for, and thinned along the loop.

import {useEffect, useState} from 'preact/hooks';

import {readSeries, type Series} from '../../api/series';
import {cycleKey, type RunPart} from '../../model/curves';
import {alongLoop, polygons} from '../../model/hysteresis';
import type {Mechanics} from '../../model/mechanics';

const MOST_LOOPS = 40;    // Of a window, calls one after the other. More loops hide each other: they wait for a zoom.
const ASKED = 1000;       // Samples of a loop: 24 kB.
const POINTS = 200;       // Of a loop that is drawn.
const REST_MS = 300;      // A window rests before its loops are asked for.

/** The samples of cycles that the series of an ended run has few of, by `cycleKey`. */
export function useLoops(name: string, {contacts}: Mechanics, part: RunPart, ended: boolean): Map<string, Series> {
  const [loops, setLoops] = useState<Map<string, Series>>(new Map());
  useEffect(() => {
    if (!ended || !part.series.thinned) return undefined;
    const control = new AbortController();
    const read = async () => {
      const shown = new Set(contacts.map((contact) => contact.name));
      const found = new Map(loops);
      const coarse = polygons({...part, loops}, part.cycles.filter(({contact}) => shown.has(contact)));
      if (coarse.length > MOST_LOOPS) return;
      for (const cycle of coarse) {
        const channels: [string, string] = [`${cycle.contact}.deformation`, `${cycle.contact}.contact_force`];
        const samples = await readSeries({name, channels, from: cycle.startTimeS, to: cycle.endTimeS, maxPoints: ASKED}, control.signal);
        found.set(cycleKey(cycle), alongLoop(samples, channels, POINTS));
      }
      if (found.size > loops.size) setLoops(found);
    };
    const timer = setTimeout(() => { read().catch(() => undefined); }, REST_MS);   // Without them loops are coarse.
    return () => { clearTimeout(timer); control.abort(); };
  }, [name, contacts, part, ended]);
  return loops;
}
