// Runs beside each other: parameters that differ, curves over each other, verdicts.

import {useEffect, useMemo, useState} from 'preact/hooks';

import {server} from '../api/client';
import {explain} from '../api/errors';
import type {Job} from '../api/generated/contact/v1/job_pb';
import {readSeries, type Series} from '../api/series';
import {compareResults, deviation, differingParameters, runNames, type Result, type Value} from '../model/comparison';
import {mechanicsOf} from '../model/mechanics';
import {compact, exact, short as digits} from '../model/numbers';
import type {Panel} from '../model/panel';
import {titleOf} from '../model/remarks';
import {typeset} from '../model/units';
import {Plot} from '../plots/plot';
import {CopyLink} from '../ui/copy';
import {LeftOut} from '../ui/left_out';
import {setPlayhead} from '../ui/playhead';
import {SaveReport} from '../ui/save_report';
import {setQuery, type Route} from '../ui/route';
import {StateBadge} from '../ui/state_badge';
import {useAsync} from '../ui/use_async';
import {setWindow, windowOf} from './run/window';

const MOST_SHOWN = 300;
const MOST_LISTED = 200;
const short = (name: string) => name.replace('jobs/', '');
const DIGITS = 7;   // Of a result; pointed at, it shows all of them.
const text = (value: Value) => (typeof value === 'number' ? compact(value, DIGITS) : value ?? '–');
const whole = (value: Value) => (typeof value === 'number' ? exact(value) : undefined);

function Picker({jobs}: {jobs: string[]}) {
  const {value: answer, error} = useAsync(() => server.listJobs({pageSize: MOST_LISTED}), []);
  const known = answer?.jobs ?? [];
  const add = (event: Event) => {
    const {value} = event.currentTarget as HTMLSelectElement;
    if (value) setQuery({jobs: [...jobs, value].join(',')});
  };
  return (
    <><label>Add a run <select value="" onChange={add}><option value="">choose …</option>
      {known.filter(({name}) => !jobs.includes(short(name))).map((job) => <option key={job.name} value={short(job.name)}>{titleOf(job) || short(job.name)} · {short(job.name)}</option>)}
    </select></label>
      {error !== undefined && <span role="alert">{explain(error)}</span>}
      {answer?.nextPageToken && <span class="soft">the newest {MOST_LISTED} runs; older ones are in the <a href="/runs">list</a></span>}</>
  );
}

function Parameters({jobs}: {jobs: Job[]}) {
  const rows = useMemo(() => differingParameters(jobs), [jobs]);
  if (rows.length === 0) return <p class="soft">The scenarios are equal.</p>;
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Parameters that differ"><table>
      <thead><tr><th>parameter (only differences)</th>{jobs.map(({name}) => <th key={name} class="number">{short(name)}</th>)}</tr></thead>
      <tbody>{rows.map(({name, values}) => <tr key={name}><td class="mono">{name}</td>{values.map((v, i) => <td key={i} class="number">{text(v)}</td>)}</tr>)}</tbody>
    </table></div>
  );
}

function Verdict({row, i}: {row: Result; i: number}) {
  const ok = row.holds[i];
  const far = deviation(row.values[i], row.values[0]);
  return <td class={`number ${ok ? '' : 'differs'}`} title={whole(row.values[i])}>{text(row.values[i])}{i > 0 && <span class={ok ? 'soft' : ''}> {ok ? '✓' : '✗'} {far}</span>}</td>;
}

function Results({jobs, query}: {jobs: Job[]; query: URLSearchParams}) {
  const relative = Number(query.get('rel') ?? 1e-6);
  const absolute = Number(query.get('abs') ?? 1e-12);
  const rows = useMemo(() => compareResults(jobs, {absolute, relative}), [jobs, absolute, relative]);
  const differing = rows.filter((row) => row.holds.includes(false));
  const wanted = query.get('rows') === 'all' ? rows : differing;
  const shown = wanted.slice(0, MOST_SHOWN);
  return (
    <section aria-label="Results">
      <div class="tools"><h2>Results</h2>
        <span class={`badge ${differing.length ? 'warn' : 'good'}`}>{differing.length ? `✗ ${differing.length} of ${rows.length} differ` : `✓ all ${rows.length} hold`}</span>
        <label>relative tolerance <input size={7} value={query.get('rel') ?? '1e-6'} onChange={(e) => setQuery({rel: e.currentTarget.value})} /></label>
        <label>absolute <input size={7} value={query.get('abs') ?? '1e-12'} onChange={(e) => setQuery({abs: e.currentTarget.value})} /></label>
        <label><input type="checkbox" checked={query.get('rows') === 'all'} onChange={(e) => setQuery({rows: e.currentTarget.checked ? 'all' : undefined})} /> all results</label>
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label="Results with verdicts"><table>
        <thead><tr><th>result</th><th>unit</th>{jobs.map(({name}, i) => <th key={name} class="number">{short(name)}{i === 0 ? ' (baseline)' : ''}</th>)}</tr></thead>
        <tbody>{shown.map((row) => <tr key={row.name}><td class="name">{row.name}</td><td class="soft">{typeset(row.unit)}</td>{jobs.map((_, i) => <Verdict key={i} row={row} i={i} />)}</tr>)}</tbody>
      </table></div>
      <LeftOut shown={shown.length} all={wanted.length} what="results" way="contactctl compare has all" />
    </section>
  );
}

function channelNames(job: Job): string[] {
  if (job.spec.case !== 'scenario') return [];
  const {bodies, contacts} = mechanicsOf(job.spec.value);
  return [...contacts.flatMap(({name}) => ['contact_force', 'deformation', 'deformation_velocity', 'external_force'].map((q) => `${name}.${q}`)),
    ...bodies.flatMap(({name}) => [`${name}.velocity`, `${name}.position`])];
}

function overlay(channel: string, labels: string[], series: (Series | undefined)[]): Panel {
  const first = series.map((s) => s?.get(channel)).find(Boolean);
  const quantity = first?.quantity.replaceAll('_', ' ') ?? channel;
  return {
    id: channel, title: channel, xLabel: 'time [s]', yLabel: `${quantity} [${first?.unit ?? '1'}]`, overTime: true,
    curves: labels.flatMap((label, i) => {
      const column = series[i]?.get(channel);
      return column ? [{label, colour: i, mark: 'line' as const, x: series[i]!.get('time')!.values, y: column.values}] : [];
    }),
  };
}

/** Moves the moment whose values all plots tell. */
function Moment({from, to}: {from: number; to: number}) {
  const [time, setTime] = useState<number>();
  useEffect(() => setPlayhead(time), [time]);
  useEffect(() => () => setPlayhead(undefined), []);
  const part = time === undefined ? 0 : (time - from) / (to - from) || 0;
  const words = time === undefined ? '' : `${digits(time * 1000, 7)} ms`;
  return <label>Values at <input class="scrub" type="range" min="0" max="1" step="0.0005" value={part} aria-label="moment" aria-valuetext={words}
    onInput={(e) => setTime(from + Number(e.currentTarget.value) * (to - from))} /> <span class="mono">{words}</span></label>;
}

function Overlay({jobs, query}: {jobs: Job[]; query: URLSearchParams}) {
  const names = useMemo(() => [...new Set(jobs.flatMap(channelNames))], [jobs]);
  const channels = (query.get('channels') ?? names.slice(0, 2).join(',')).split(',').filter((name) => names.includes(name));
  const window = windowOf(query, 0);
  const series = useAsync(() => Promise.all(jobs.map(async (job) => {
    const own = channels.filter((c) => channelNames(job).includes(c));
    return own.length ? readSeries({name: job.name, channels: own, from: window?.[0], to: window?.[1], maxPoints: 3000}).catch(() => undefined) : undefined;
  })), [jobs, channels.join(), window?.[0], window?.[1]]).value;
  const labels = useMemo(() => runNames(jobs), [jobs]);
  const panels = useMemo(() => channels.map((c) => overlay(c, labels, series ?? [])), [series, labels, channels.join()]);
  const times = series?.find(Boolean)?.get('time')?.values;
  const set = (list: string[]) => setQuery({channels: list.join(',')});
  return (
    <section aria-label="Overlay">
      <div class="tools"><h2>Overlay</h2>
        <label>Add a channel <select value="" onChange={(e) => set([...channels, e.currentTarget.value])}><option value="">choose …</option>
          {names.filter((n) => !channels.includes(n)).map((n) => <option key={n}>{n}</option>)}</select></label>
        {channels.map((c) => <button key={c} type="button" class="quiet" aria-label={`remove ${c}`} onClick={() => set(channels.filter((o) => o !== c))}>{c} ✕</button>)}
        {times && times.length > 0 && <Moment from={times[0]!} to={times.at(-1)!} />}
        {window && <button type="button" onClick={() => setWindow(undefined)}>All the time</button>}
      </div>
      <div class="plots">{panels.map((panel) => <Plot key={panel.id} panel={panel} window={window} onZoom={setWindow} source={jobs.map(({name}) => name).join(' ')} height={260} />)}</div>
    </section>
  );
}

export function Compare({route: {query}}: {route: Route}) {
  const ids = (query.get('jobs') ?? '').split(',').filter(Boolean);
  const [jobs, setJobs] = useState<Job[]>([]);
  const {value, error} = useAsync((signal) => Promise.all(ids.map((id) => server.getJob({name: `jobs/${id}`}, {signal}))), [ids.join()]);
  useEffect(() => { if (value) setJobs(value); }, [value]);
  return (
    <>
      <div class="head"><h1>Compare</h1><Picker jobs={ids} />{ids.length > 0 && <span class="actions"><CopyLink /><SaveReport jobs={ids.map((id) => `jobs/${id}`)} /></span>}</div>
      {error !== undefined && <p class="notice" role="alert">{explain(error)}</p>}
      {ids.length === 0 && <p class="nothing">Choose runs here, or mark them in the <a href="/runs">list</a>. The first one is the baseline.</p>}
      <ul class="chips">{jobs.map((job) => (
        <li key={job.name}><a href={`/runs/${short(job.name)}`}>{titleOf(job) || short(job.name)}</a> <span class="mono soft">{short(job.name)}</span> <StateBadge {...job} />
          <button type="button" class="quiet" aria-label={`remove ${short(job.name)}`} onClick={() => setQuery({jobs: ids.filter((id) => id !== short(job.name)).join(',')})}>✕</button></li>))}
      </ul>
      {jobs.length >= 2 && <section aria-label="Parameters"><h2>Parameters</h2><Parameters jobs={jobs} /></section>}
      {jobs.length >= 1 && <Overlay jobs={jobs} query={query} />}
      {jobs.length >= 2 && <Results jobs={jobs} query={query} />}
    </>
  );
}
