// One job: a run, or a sweep.

import {useEffect, useMemo} from 'preact/hooks';

import type {RunState} from '../../model/runState';
import {mechanicsOf} from '../../model/mechanics';
import {setPlayhead} from '../../ui/playhead';
import {LinkNote} from '../../ui/link_note';
import type {Route} from '../../ui/route';
import {Sweep} from '../sweep/sweep';
import {Details} from './details';
import {Header} from './header';
import {Iterations} from './iterations';
import {Ledger} from './ledger';
import {Motion} from './motion';
import {StripView} from './strip_view';
import {useRun} from './use_run';
import {windowOf} from './window';

function Scenario({id, run, query}: {id: string; run: RunState; query: URLSearchParams}) {
  const spec = run.job!.spec;
  const mechanics = useMemo(() => (spec.case === 'scenario' ? mechanicsOf(spec.value) : undefined), [run.job!.name]);
  if (!mechanics) return null;
  const {scenario} = mechanics;
  const newest = run.job?.summary?.timeReachedS ?? run.progress?.timeS ?? 0;
  const window = windowOf(query, newest);
  const source = [run.job!.title, `jobs/${id}`, run.job!.serverVersion && `contactd ${run.job!.serverVersion}`].filter(Boolean).join(' · ');
  const recorded = !scenario.output?.ledgerOnly;
  return (
    <>
      {recorded && <StripView run={run} mechanics={mechanics} window={window} query={query} />}
      <Iterations run={run} query={query} source={source} />
      {recorded ? <Motion run={run} mechanics={mechanics} query={query} window={window} whole={[0, newest || scenario.endTimeS]} source={source} />
        : <p class="nothing">This run records no trajectory, only its ledger.</p>}
      <Ledger run={run} query={query} />
    </>
  );
}

export function Run({route}: {route: Route}) {
  const id = route.path.split('/')[2]!;
  const {run, link} = useRun(id);
  useEffect(() => { document.title = `${run.job?.title || id} · contactd`; }, [run.job?.title]);
  useEffect(() => () => setPlayhead(undefined), [id]);
  return (
    <>
      <LinkNote link={link} />
      {run.job && <Header id={id} run={run} />}
      {run.job?.spec.case === 'scenario' && <Scenario id={id} run={run} query={route.query} />}
      {run.job?.spec.case === 'sweep' && <Sweep id={id} run={run} query={route.query} />}
      {run.job?.spec.case && <Details run={run} />}
    </>
  );
}
