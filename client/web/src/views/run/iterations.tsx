// μ and residual, pass by pass, as they converge.

import {useMemo, useRef} from 'preact/hooks';

import {episodesOf, hardestEpisode, iterationPanels, newestEpisode} from '../../model/iterations';
import type {RunState} from '../../model/runState';
import {isFinal} from '../../api/watch';
import {count} from '../../model/numbers';
import {Plot} from '../../plots/plot';
import {setQuery} from '../../ui/route';
import {Passes} from './passes';

interface Props {
  run: RunState;
  query: URLSearchParams;
  source: string;
  /** Of μ. */
  unit: string;
}

const READ_MS = 1000;   // For which an episode stays, so that people can read it.

/** A value that changes no more often than every so many milliseconds. */
function useSlow<T>(value: T, ms: number): T {
  const held = useRef({value, since: -Infinity});
  const now = performance.now();
  if (now - held.current.since >= ms) held.current = {value, since: now};
  return held.current.value;
}

/** The episode to show: the one chosen, else the newest while the job runs, else the hardest. */
function useEpisode(run: RunState, query: URLSearchParams): number {
  const newest = useSlow(newestEpisode(run.iterations), READ_MS);
  const chosen = Number(query.get('episode') ?? NaN);
  if (chosen > 0) return chosen;
  return (isFinal(run.state) ? hardestEpisode(run.iterations) : newest) ?? 1;
}

/** Why an episode has no points. */
function emptyOf({dropped, droppedTo, iterations}: RunState, episode: number): string {
  if (dropped > 0 && episode <= droppedTo) return `The passes of episode ${count(episode)} are no longer in this page.`;
  return iterations.length > 0 ? `No μ is sought in episode ${count(episode)}.` : 'No cycle needed an iteration.';
}

function Kept({dropped, droppedTo, iterations}: RunState) {
  if (dropped === 0) return null;
  return (
    <p class="soft">The newest {count(iterations.length)} of {count(dropped + iterations.length)} passes are shown; those
      before, up to episode {count(droppedTo)}, are not. <code>contactctl watch</code> has all.</p>
  );
}

function Episode({run, episode, last, chosen}: {run: RunState; episode: number; last: number; chosen: boolean}) {
  const hardest = run.dropped > 0 ? 'The one with most passes of those shown' : 'The one with most passes';
  return (
    <>
      <label>Episode <input type="number" size={6} min={1} max={last} value={episode}
        onChange={(e) => setQuery({episode: e.currentTarget.value})} /> of {count(last)}</label>
      {chosen && <button type="button" onClick={() => setQuery({episode: undefined})}>
        {isFinal(run.state) ? hardest : 'Follow the newest'}</button>}
    </>
  );
}

export function Iterations({run, query, source, unit}: Props) {
  const episode = useEpisode(run, query);
  const version = run.dropped + run.iterations.length;
  const relative = query.has('relative');
  const panels = useMemo(() => iterationPanels(run.iterations, episode, unit, relative), [version, episode, unit, relative]);
  const episodes = useMemo(() => [...episodesOf(run.iterations).keys()], [version]);
  return (
    <section aria-label="Iterations">
      <div class="tools"><h2>Iteration of μ</h2>
        {(episodes.length > 1 || run.dropped > 0) && <Episode run={run} episode={episode} last={episodes.at(-1)!} chosen={query.has('episode')} />}
        {run.iterations.length > 0 && <label><input type="checkbox" checked={relative} onChange={(e) => setQuery({relative: e.currentTarget.checked ? '1' : undefined})} /> Δμ/μ</label>}
      </div>
      <Kept {...run} />
      <div class="plots">
        {panels.map((panel) => <Plot key={panel.id} panel={panel} source={source} height={210} empty={emptyOf(run, episode)} />)}
      </div>
      {run.iterations.length > 0 && <Passes iterations={run.iterations} episode={episode} version={version} query={query} unit={unit} />}
    </section>
  );
}
