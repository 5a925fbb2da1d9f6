// One job: a run, or a sweep.

import {useEffect, useMemo, useState} from 'preact/hooks';

import {isFinal} from '../../api/watch';
import {formulasIn, type Formula} from '../../model/derived';
import {mechanicsOf, muUnit, type Mechanics} from '../../model/mechanics';
import type {Measured} from '../../model/overlay';
import {presetsAsked} from '../../model/presets';
import {titleOf} from '../../model/remarks';
import type {RunState} from '../../model/runState';
import type {Cycle} from '../../api/generated/contact/v1/job_pb';
import type {Scenario as ScenarioMessage} from '../../api/generated/contact/v1/scenario_pb';
import {setPlayhead} from '../../ui/playhead';
import {LinkNote} from '../../ui/link_note';
import {useOthers, useParameter, type Route} from '../../ui/route';
import {Sweep} from '../sweep/sweep';
import {Details} from './details';
import {Header} from './header';
import {Iterations} from './iterations';
import {Ledger} from './ledger';
import {Measurements} from './measured/drop';
import {Motion, partFor} from './motion';
import {StripView, stripChannels} from './strip_view';
import {useRun} from './use_run';
import {useSeries} from './use_series';
import {windowOf} from './window';

/** The columns of all plots and the strip, each once. */
function channelsOf(mechanics: Mechanics, contact: string | null, all: boolean, ended: Cycle[], formulas: Formula[]): string[] {
  if (mechanics.scenario.output?.ledgerOnly) return [];
  const ofPlots = presetsAsked(mechanics, all).flatMap((preset) => preset.channels(partFor(preset, mechanics, contact, all, ended)));
  return [...new Set([...ofPlots, ...stripChannels(mechanics), ...formulas.flatMap(({channels}) => channels)])].filter((name) => name !== 'time');
}

function Recording({id, run, query}: {id: string; run: RunState; query: URLSearchParams}) {
  const spec = run.job!.spec;
  const mechanics = useMemo(() => mechanicsOf(spec.value as ScenarioMessage), [run.job!.name]);
  const {scenario} = mechanics;
  const unit = muUnit(mechanics.contacts);
  const newest = run.job?.summary?.timeReachedS ?? run.progress?.timeS ?? 0;
  const window = windowOf(query, newest);
  const source = [titleOf(run.job!), `jobs/${id}`, run.job!.serverVersion && `contactd ${run.job!.serverVersion}`].filter(Boolean).join(' · ');
  const all = query.has('plots');
  const ended = useMemo(() => (isFinal(run.state) ? run.cycles : []), [isFinal(run.state) && run.cycles.length]);
  const texts = useParameter('derived');
  const formulas = useMemo(() => formulasIn(texts, mechanics), [texts, mechanics]);
  const channels = useMemo(() => channelsOf(mechanics, query.get('contact'), all, ended, formulas), [mechanics, query.get('contact'), all, ended, formulas]);
  const {series, window: drawn} = useSeries(run.job!.name, channels, window, isFinal(run.state) ? -1 : run.progress?.timeS ?? 0);
  const recorded = !scenario.output?.ledgerOnly;
  const choice = useOthers(query, 'from', 'to');   // A zoom leaves all but the plots over time as they are.
  const strip = useMemo(() => <StripView mechanics={mechanics} series={series} query={choice} />, [mechanics, series, choice]);
  const iterations = useMemo(() => <Iterations run={run} query={choice} source={source} unit={unit} />, [run, choice, source]);
  const [measured, setMeasured] = useState<Measured>();
  const measurements = useMemo(() => recorded && isFinal(run.state) && newest > 0 && (
    <Measurements name={run.job!.name} end={newest} query={choice} onMeasured={setMeasured} />), [run.job!.name, newest, recorded, isFinal(run.state), choice]);
  const ledger = useMemo(() => <Ledger run={run} query={choice} unit={unit} />, [run, choice]);
  return (
    <>
      {recorded && strip}
      {iterations}
      {measurements}
      {recorded ? <Motion run={run} ended={ended} formulas={formulas} mechanics={mechanics} measured={measured} series={series} query={choice} window={window} drawn={drawn} whole={[0, newest || scenario.endTimeS]} source={source} />
        : <p class="nothing">This run records no trajectory, only its ledger.</p>}
      {ledger}
    </>
  );
}

export function Run({route}: {route: Route}) {
  const id = route.path.split('/')[2]!;
  const {run, link} = useRun(id);
  useEffect(() => () => setPlayhead(undefined), [id]);
  const header = useMemo(() => <Header id={id} run={run} />, [id, run]);
  const details = useMemo(() => <Details run={run} />, [run]);
  return (
    <>
      <LinkNote link={link} />
      {run.job ? header : <div class="head"><h1>Run {id}</h1></div>}
      {!run.job && (link.state === 'lost' ? <p class="nothing"><a href="/runs">All runs</a></p> : <p class="nothing" role="status">Loading …</p>)}
      {run.job?.spec.case === 'scenario' && <Recording id={id} run={run} query={route.query} />}
      {run.job?.spec.case === 'sweep' && <Sweep id={id} run={run} query={route.query} />}
      {run.job?.spec.case && details}
    </>
  );
}
