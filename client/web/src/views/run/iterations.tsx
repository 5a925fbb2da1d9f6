// μ and residual, pass by pass, as they converge.

import {useMemo} from 'preact/hooks';

import {episodesOf, hardestEpisode, iterationPanels} from '../../model/iterations';
import type {RunState} from '../../model/runState';
import {isFinal} from '../../api/watch';
import {count} from '../../model/numbers';
import {Plot} from '../../plots/plot';
import {setQuery} from '../../ui/route';

interface Props {
  run: RunState;
  query: URLSearchParams;
  source: string;
}

/** The episode to show: the one chosen, else the newest while the job runs, else the hardest. */
function episodeOf(run: RunState, query: URLSearchParams): number {
  const chosen = Number(query.get('episode') ?? NaN);
  if (chosen > 0) return chosen;
  const newest = run.iterations.at(-1)?.episode;
  return (isFinal(run.state) ? hardestEpisode(run.iterations) : newest) ?? 1;
}

export function Iterations({run, query, source}: Props) {
  const episode = episodeOf(run, query);
  const panels = useMemo(() => iterationPanels(run.iterations, episode), [run.iterations.length, episode]);
  const episodes = useMemo(() => [...episodesOf(run.iterations).keys()], [run.iterations.length]);
  return (
    <section aria-label="Iterations">
      <div class="tools"><h2>Iteration of μ</h2>
        {episodes.length > 1 && (
          <>
            <label>Episode <input type="number" size={6} min={1} max={episodes.at(-1)} value={episode}
              onChange={(e) => setQuery({episode: e.currentTarget.value})} /> of {count(episodes.at(-1)!)}</label>
            {query.has('episode') && <button type="button" onClick={() => setQuery({episode: undefined})}>
              {isFinal(run.state) ? 'The one with most passes' : 'Follow the newest'}</button>}
          </>
        )}
      </div>
      <div class="plots">
        {panels.map((panel) => <Plot key={panel.id} panel={panel} source={source} height={210} empty="No cycle needed an iteration." />)}
      </div>
    </section>
  );
}
