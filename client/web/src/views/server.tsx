// The server: what it does now, what it allows, who it takes the caller for, its metrics.

import {useEffect, useState} from 'preact/hooks';

import {server} from '../api/client';
import {explain} from '../api/errors';
import {Quota_Resource, type ServerInfo} from '../api/generated/contact/v1/job_service_pb';
import {token} from '../api/token';
import {bytes, count, exact, seconds} from '../model/numbers';
import {parseMetrics, type Family} from '../model/prometheus';
import {setQuery, type Route} from '../ui/route';
import {epoch, utc} from '../ui/times';

const EVERY_MS = 2000;
const KEPT = 90;   // Values in a small line: three minutes.

interface Seen {
  info?: ServerInfo;
  metrics: Family[];
  queued: number[];
  running: number[];
  why: string;
  metricsWhy: string;
}

async function metricsNow(): Promise<Family[]> {
  const answer = await fetch('/metrics', token() ? {headers: {authorization: `Bearer ${token()}`}} : {});
  if (!answer.ok) throw new Error((await answer.text()).slice(0, 200));
  return parseMetrics(await answer.text());
}

/** Asks again and again. */
function useServer(): Seen {
  const [seen, setSeen] = useState<Seen>({metrics: [], queued: [], running: [], why: '', metricsWhy: ''});
  useEffect(() => {
    let alive = true;
    let timer = 0;
    const ask = async () => {
      const [info, metrics] = await Promise.allSettled([server.getServerInfo({}), metricsNow()]);
      if (!alive) return;
      setSeen((last) => ({
        ...last,
        ...(info.status === 'fulfilled' ? {
          info: info.value, why: '',
          queued: [...last.queued, info.value.queuedJobs].slice(-KEPT), running: [...last.running, info.value.runningJobs].slice(-KEPT),
        } : {why: explain(info.reason)}),
        ...(metrics.status === 'fulfilled' ? {metrics: metrics.value, metricsWhy: ''} : {metricsWhy: String((metrics.reason as Error).message)}),
      }));
      timer = setTimeout(() => void ask(), EVERY_MS) as unknown as number;
    };
    void ask();
    return () => { alive = false; clearTimeout(timer); };
  }, []);
  return seen;
}

function Spark({values}: {values: number[]}) {
  const top = Math.max(1, ...values);
  const points = values.map((v, i) => `${160 * i / (KEPT - 1)},${28 - 26 * v / top}`).join(' ');
  return <svg class="spark" width="160" height="30" aria-hidden="true"><polyline points={points} fill="none" stroke="currentColor" stroke-width="1.5" /></svg>;
}

function Tile({name, value, of, values}: {name: string; value: number; of?: string; values: number[]}) {
  return <div class="tile"><span class="soft">{name}</span><strong>{count(value)}</strong>{of && <span class="soft">{of}</span>}<Spark values={values} /></div>;
}

function limitsOf({limits}: ServerInfo): [string, string][] {
  if (!limits) return [];
  const many = (n: number | bigint, none = 'no limit') => (Number(n) === 0 ? none : count(n));
  const lasts = (d: {seconds: bigint} | undefined, none: string) => (d && d.seconds > 0n ? seconds(Number(d.seconds)) : none);
  return [
    ['bodies in a scenario', many(limits.maxBodies)], ['contacts in a scenario', many(limits.maxContacts)],
    ['samples in a recording', many(limits.maxSamples)], ['cells of a sweep', many(limits.maxCells)],
    ['waiting jobs', many(limits.maxQueuedJobs)], ['watchers', many(limits.maxWatchers)],
    ['watchers of one peer', many(limits.maxWatchersPerPeer)], ['connections', many(limits.maxConnections)],
    ['bytes in a request', bytes(limits.maxMessageBytes)],
    ['new jobs of one peer per second', many(limits.maxCreatesPerSecond)],
    ['steps of a job', many(limits.maxBudget?.steps ?? 0)], ['wall time of a job', lasts(limits.maxBudget?.wallTime, 'no limit')],
    ['bytes of a job', limits.maxBudget?.outputBytes ? bytes(limits.maxBudget.outputBytes) : 'no limit'],
    ['time without a step', lasts(limits.stepTimeout, 'no limit')], ['attempts of a job', many(limits.maxAttempts)],
    ['ended jobs are kept', lasts(limits.retention, 'for ever')], ['trajectories are kept', lasts(limits.compaction, 'for ever')],
    ['bytes of the store', limits.maxStoredBytes ? bytes(limits.maxStoredBytes) : 'what the disk has'],
  ];
}

function Pairs({pairs}: {pairs: [string, string][]}) {
  return <dl>{pairs.map(([name, text]) => <div key={name}><dt>{name}</dt><dd>{text}</dd></div>)}</dl>;
}

function Metrics({families, why, words}: {families: Family[]; why: string; words: string}) {
  const shown = families.filter(({name, help}) => `${name} ${help}`.includes(words));
  return (
    <section aria-label="Metrics"><div class="tools"><h2>Metrics</h2>
      <label>Find <input type="search" value={words} onInput={(e) => setQuery({find: e.currentTarget.value})} /></label>
      <a href="/metrics" target="_blank">as Prometheus reads them</a></div>
      {why && <p class="soft">{why}</p>}
      <div class="scroll tall" tabIndex={0} role="region" aria-label="Metrics"><table><tbody>{shown.flatMap(({help, samples}) =>
        samples.filter(({name}) => !name.endsWith('_bucket')).map(({name, labels, value}) => (
          <tr key={name + labels} title={help}><td class="mono">{name}</td><td class="soft">{labels}</td><td class="number">{exact(value)}</td></tr>)))}</tbody></table></div>
    </section>
  );
}

export function Server({route: {query}}: {route: Route}) {
  const {info, metrics, queued, running, why, metricsWhy} = useServer();
  return (
    <>
      <div class="head"><h1>Server</h1></div>
      {why && <p class="notice" role="status">{why}</p>}
      {info && (
        <>
          <div class="tiles">
            <Tile name="queued" value={info.queuedJobs} of={`of ${count(info.limits?.maxQueuedJobs ?? 0)}`} values={queued} />
            <Tile name="running" value={info.runningJobs} of={`of ${info.workers} workers`} values={running} />
          </div>
          <section class="details" aria-label="About the server">
            <div><h3>Version</h3><Pairs pairs={[['contactd', info.version], ['revision', info.revision || 'unknown'], ['instance', info.instanceId],
              ['started', utc(info.startTime)], ['up', info.startTime ? seconds(Math.max(Date.now() / 1000 - epoch(info.startTime), 0)) : '']]} />
              <h3>You</h3><Pairs pairs={[['principal', info.principal?.name ?? ''], ['tenant', info.principal?.tenant ?? ''], ['roles', info.principal?.roles.join(', ') ?? ''], ['known by', info.principal?.how ?? '']]} /></div>
            <div><h3>Limits</h3><Pairs pairs={limitsOf(info)} /></div>
            {info.quotas.length > 0 && <div><h3>Your quotas</h3><Pairs pairs={info.quotas.map((q) => [Quota_Resource[q.resource]!.toLowerCase().replaceAll('_', ' '), `${count(q.used)} of ${q.limit ? count(q.limit) : 'any number'}`])} /></div>}
          </section>
        </>
      )}
      <Metrics families={metrics} why={metricsWhy} words={query.get('find') ?? ''} />
    </>
  );
}
