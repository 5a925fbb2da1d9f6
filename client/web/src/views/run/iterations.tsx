// μ and residual, pass by pass, as they converge.

import {useMemo} from 'preact/hooks';

import {episodesOf, hardestEpisode, iterationPanels} from '../../model/iterations';
import type {RunState} from '../../model/runState';
import {isFinal} from '../../api/watch';
import {Plot} from '../../plots/plot';
import {setQuery} from '../../ui/route';

interface Props {
  run: RunState;
  query: URLSearchParams;
  source: string;
}

const MOST_LISTED = 1000;

/** The episode to show: the one chosen, else the newest while the job runs, else the hardest. */
function episodeOf(run: RunState, query: URLSearchParams): number {
  const chosen = Number(query.get('episode') ?? NaN);
  if (chosen > 0) return chosen;
  const newest = run.iterations.at(-1)?.episode;
  return (isFinal(run.state) ? hardestEpisode(run.iterations) : newest) ?? 1;
}

export function Iterations({run, query, source}: Props) {
  const episode = episodeOf(run, query);
  const panels = useMemo(() => iterationPanels(run.iterations, episode), [run.version, episode]);
  const episodes = useMemo(() => [...episodesOf(run.iterations)].slice(-MOST_LISTED), [run.version]);
  return (
    <section aria-label="Iterations">
      <div class="tools"><h2>Iteration of μ</h2>
        {episodes.length > 1 && (
          <label>Episode <select value={query.get('episode') ?? ''} onChange={(e) => setQuery({episode: e.currentTarget.value})}>
            <option value="">{isFinal(run.state) ? 'the one with most passes' : 'the newest'} ({episode})</option>
            {episodes.map(([number, last]) => <option key={number} value={number}>{number}: {last} corrections</option>)}
          </select></label>
        )}
      </div>
      <div class="plots">
        {panels.map((panel) => <Plot key={panel.id} panel={panel} source={source} height={210} empty="No cycle needed an iteration." />)}
      </div>
    </section>
  );
}
