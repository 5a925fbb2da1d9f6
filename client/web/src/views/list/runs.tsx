// All jobs, live.

import type {ComponentChildren} from 'preact';
import {useEffect, useMemo, useRef, useState} from 'preact/hooks';

import {Job_Convergence, type Job} from '../../api/generated/contact/v1/job_pb';
import type {Link} from '../../api/stream';
import {watchJobs} from '../../api/watch';
import {bestOf, chosenOf, grouped, groupOf, isPinned, JobList, labelKeys, METRICS, NOT_CONVERGED, labelsOf, statesOf} from '../../model/job_list';
import type {Fields} from '../../model/job_fields';
import {count, exact} from '../../model/numbers';
import {noteHint, plainLabels, titleOf} from '../../model/remarks';
import {save} from '../../ui/save';
import {LinkNote} from '../../ui/link_note';
import {setQuery, type Route} from '../../ui/route';
import {StateBadge} from '../../ui/state_badge';
import {clock, localField, utcOfField} from '../../ui/times';
import {elapsed} from '../elapsed';
import {Bulk} from './bulk';
import {useFields} from './use_fields';

const PAGE = 50;
const MOST_NAMED = 100;   // Fields to choose among.
const idOf = ({name}: Job) => name.replace('jobs/', '');
const STATES = ['QUEUED', 'RUNNING', 'SUCCEEDED', NOT_CONVERGED, 'FAILED', 'CANCELLED'];

/** The jobs of a filter, as they change. */
function useJobs(state: string, labels: string): {jobs: Job[]; link: Link; complete: boolean} {
  const [shown, setShown] = useState<{jobs: Job[]; complete: boolean}>({jobs: [], complete: false});
  const [link, setLink] = useState<Link>({state: 'connecting'});
  useEffect(() => {
    const control = new AbortController();
    const list = new JobList();
    let frame = 0;
    const show = () => {
      frame = 0;
      setShown({jobs: list.sorted(), complete: list.complete});
    };
    void watchJobs({states: statesOf(state), labels: labelsOf(labels)}, () => list.begin(), (change) => {
      list.take(change);
      frame ||= requestAnimationFrame(show);
    }, setLink, control.signal);
    return () => { control.abort(); cancelAnimationFrame(frame); };
  }, [state, labels]);
  return {...shown, link};
}

function Row({job, metric, best, chosen, choose, values}: {
  job: Job; metric: number | undefined; best: boolean; chosen: boolean; choose: (on: boolean) => void; values: (string | undefined)[];
}) {
  const id = idOf(job);
  return (
    <tr>
      <td><input type="checkbox" aria-label={`choose ${id}`} checked={chosen} onChange={(e) => choose(e.currentTarget.checked)} /></td>
      <td class="title">{isPinned(job) && <span class="best" title="pinned">▲ </span>}<a href={`/runs/${id}`} title={job.title}>{titleOf(job) || id}</a>{job.note && <div class="soft" title={job.note}>{noteHint(job.note)}</div>}</td>
      <td class="soft mono">{id}</td>
      <td><StateBadge state={job.state} convergence={job.convergence} /></td>
      <td class="labels">{(job.progress?.cells ?? 0) > 0 && <span class="label">sweep of {count(job.progress!.cells)}</span>}{plainLabels(job.labels).map(([k, v]) => <span key={k} class="label">{k}={v}</span>)}</td>
      {values.map((value, i) => <td key={i} class="number">{value ?? ''}</td>)}
      <td class="number">{metric === undefined ? '' : exact(metric)}{best && <span class="best" title="least of those that converged"> ★</span>}</td>
      <td class="number">{elapsed(job)}</td>
      <td class="number">{clock(job.createTime)}</td>
    </tr>
  );
}

function Filters({query, keys, children}: {query: URLSearchParams; keys: string[]; children: ComponentChildren}) {
  const change = (key: string) => (e: Event) =>
    setQuery({[key]: (e.currentTarget as HTMLInputElement).value, page: undefined});
  const time = (key: string) => (
    <input type="datetime-local" value={localField(query.get(key) ?? '')}
      onChange={(e) => setQuery({[key]: utcOfField(e.currentTarget.value), page: undefined})} />);
  return (
    <div class="tools" role="search">
      <label>Find <input type="search" value={query.get('q') ?? ''} placeholder="title, name, label, note" onInput={change('q')} /></label>
      <label>State <select value={query.get('state') ?? ''} onChange={change('state')}>
        <option value="">all</option>{STATES.map((s) => <option key={s} value={s}>{s.toLowerCase().replace('_', ' ')}</option>)}
      </select></label>
      <label>Label <input value={query.get('label') ?? ''} placeholder="key=value" onChange={change('label')} /></label>
      <span class="group"><label>Created after {time('after')}</label>
        <label>before {time('before')}</label></span>
      <label>Metric <select value={query.get('metric') ?? 'iterations'} onChange={change('metric')}>
        {METRICS.map(({id, label}) => <option key={id} value={id}>{label}</option>)}
      </select></label>
      <label>Order <select value={query.get('sort') ?? ''} onChange={change('sort')}>
        <option value="">newest first</option><option value="metric">by metric</option><option value="title">by title</option>
      </select></label>
      <label>Group <select value={query.get('group') ?? ''} onChange={change('group')}>
        <option value="">none</option><option value="title">by title</option>{keys.map((key) => <option key={key} value={`label:${key}`}>by label {key}</option>)}
      </select></label>
      {children}
    </div>
  );
}

/** A choice of fields of the scenarios, each a column. */
function AddColumn({fields, shown, onLook}: {fields: Fields[]; shown: string[]; onLook: () => void}) {
  const [names, setNames] = useState<string[]>([]);
  useEffect(() => { void import('../../model/job_fields').then(({varyingFields}) => setNames(varyingFields(fields).slice(0, MOST_NAMED))); }, [fields.length]);
  return (
    <label>Column <select value="" onFocus={onLook} onChange={(e) => setQuery({fields: [...shown, e.currentTarget.value].join(',')})}>
      <option value="">{fields.length > 0 && names.length === 0 ? 'no field differs' : 'add a field …'}</option>
      {names.filter((name) => !shown.includes(name)).map((name) => <option key={name}>{name}</option>)}
    </select></label>
  );
}

function Pages({page, pages, total}: {page: number; pages: number; total: number}) {
  const to = (n: number) => setQuery({page: n > 0 ? String(n + 1) : undefined});
  return (
    <div class="tools pages">
      <button type="button" disabled={page === 0} onClick={() => to(page - 1)}>‹ Newer</button>
      <span aria-live="polite">page {page + 1} of {pages}, {count(total)} {total === 1 ? 'run' : 'runs'}</span>
      <button type="button" disabled={page + 1 >= pages} onClick={() => to(page + 1)}>Older ›</button>
      <button type="button" disabled={page + 1 >= pages} onClick={() => to(pages - 1)}>Last</button>
    </div>
  );
}

function ordered(jobs: Job[], sort: string | null, metric: (job: Job) => number | undefined): Job[] {
  if (sort === 'title') return [...jobs].sort((a, b) => titleOf(a).localeCompare(titleOf(b)));
  if (sort !== 'metric') return jobs;
  return [...jobs].sort((a, b) => (metric(a) ?? Infinity) - (metric(b) ?? Infinity));
}

export function Runs({route: {query}}: {route: Route}) {
  const [words, state, after, before] = ['q', 'state', 'after', 'before'].map((name) => query.get(name) ?? '') as [string, string, string, string];
  const {jobs, link, complete} = useJobs(state, query.get('label') ?? '');
  const chosen = (query.get('chosen') ?? '').split(',').filter(Boolean);
  const table = useRef<HTMLTableElement>(null);
  const metric = METRICS.find(({id}) => id === query.get('metric')) ?? METRICS[0]!;
  const by = query.get('group') ?? '';
  const found = useMemo(() => grouped(ordered(chosenOf(jobs, {words, state, after, before}), query.get('sort'), metric.of), by),
    [jobs, words, state, after, before, metric, query.get('sort'), by]);
  const best = useMemo(() => bestOf(found, metric), [found, metric]);
  const pages = Math.max(1, Math.ceil(found.length / PAGE));
  const page = Math.min(Math.max(Number(query.get('page') ?? 1) - 1, 0), pages - 1);
  const rows = found.slice(page * PAGE, (page + 1) * PAGE);
  const columns = (query.get('fields') ?? '').split(',').filter(Boolean);
  const [looked, setLooked] = useState(false);
  const fields = useFields(rows.map(({name}) => name), looked || columns.length > 0);
  const known = rows.flatMap(({name}) => fields.get(name) ?? []);
  const head = (job: Job, before: Job | undefined) => by && (!before || groupOf(before, by) !== groupOf(job, by))
    && <tr key={`group ${job.name}`}><th colSpan={8 + columns.length} scope="rowgroup">{groupOf(job, by)}, {count(found.filter((other) => groupOf(other, by) === groupOf(job, by)).length)}</th></tr>;
  const saveCsv = async () => {
    const {listCsv} = await import('../../model/job_fields');
    save('runs.csv', new Blob([listCsv(found, metric, columns, fields)], {type: 'text/csv'}));
  };
  const choose = (id: string, on: boolean) => setQuery({chosen: [...chosen.filter((other) => other !== id), ...(on ? [id] : [])].join(',')});
  return (
    <>
      <div class="head"><h1>Runs</h1>
        <a class="button primary" href="/new">New run</a>
        {chosen.length >= 2 && <a class="button" href={`/compare?jobs=${chosen.join(',')}`}>Compare {chosen.length} runs</a>}
        {chosen.length > 0 && <button type="button" onClick={() => setQuery({chosen: undefined})}>Choose none</button>}
        {chosen.length > 0 && <Bulk jobs={jobs.filter((job) => chosen.includes(idOf(job)))} gone={(those) => setQuery({chosen: chosen.filter((id) => !those.some((job) => idOf(job) === id)).join(',')})} />}
      </div>
      <LinkNote link={link} />
      <Filters query={query} keys={labelKeys(jobs)}><AddColumn fields={known} shown={columns} onLook={() => setLooked(true)} />
        <button type="button" onClick={() => void saveCsv()}>List as CSV</button></Filters>
      <div class="scroll" tabIndex={0} role="region" aria-label="Runs">
        <table ref={table} class="runs">
          <thead><tr><th><span class="hidden">choose</span></th><th>Title</th><th>Name</th><th>State</th><th>Labels</th>
            {columns.map((name) => <th key={name} class="number mono">{name} <button type="button" class="quiet" aria-label={`remove column ${name}`} onClick={() => setQuery({fields: columns.filter((other) => other !== name).join(',')})}>✕</button></th>)}
            <th class="number">{metric.label}</th><th class="number">took</th><th class="number">created</th></tr></thead>
          <tbody>{rows.flatMap((job, i) => [head(job, rows[i - 1]), (
            <Row key={job.name} job={job} values={columns.map((name) => fields.get(job.name)?.get(name))} metric={metric.of(job)} best={best !== undefined && metric.of(job) === best && job.convergence === Job_Convergence.FULL}
              chosen={chosen.includes(idOf(job))} choose={(on) => choose(idOf(job), on)} />)])}
          </tbody>
        </table>
      </div>
      {complete && found.length === 0 && (
        <p class="nothing">{jobs.length === 0 && !state && !query.get('label') ? <>No runs yet. <a href="/new">Start the first one.</a></> : 'No run matches.'}</p>
      )}
      {found.length > 0 && <Pages page={page} pages={pages} total={found.length} />}
    </>
  );
}
