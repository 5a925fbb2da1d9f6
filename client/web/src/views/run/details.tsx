// The end of the run, its cost, its files, where it comes from, and its scenario.

import {toJson} from '@bufbuild/protobuf';
import {useState} from 'preact/hooks';

import {readArtifact} from '../../api/artifact';
import {explain} from '../../api/errors';
import {ScenarioSchema, SweepSchema} from '../../api/generated/contact/v1/scenario_pb';
import {LogEntry_Severity, type LogEntry} from '../../api/generated/contact/v1/event_pb';
import type {FinalBody, Job, RunSummary} from '../../api/generated/contact/v1/job_pb';
import {count, exact} from '../../model/numbers';
import type {RunState} from '../../model/runState';
import {useAsync} from '../../ui/use_async';
import {LeftOut} from '../../ui/left_out';
import {save} from '../../ui/save';
import {utc} from '../../ui/times';

const MOST_BODIES = 100;
const MOST_FILES = 50;
const MOST_REMARKS = 100;

function Pairs({pairs}: {pairs: [string, string][]}) {
  return <dl>{pairs.filter(([, text]) => text).map(([name, text]) => <div key={name}><dt>{name}</dt><dd>{text}</dd></div>)}</dl>;
}

function costOf(s: RunSummary): [string, string][] {
  return [
    ['steps', count(s.steps)], ['evaluations', count(s.evaluations)], ['episodes', count(s.episodes)],
    ['corrections of μ', count(s.iterations)], ['wall time', `${exact(s.wallTimeS)} s`],
    ['momentum residual', exact(s.momentumResidual)], ['energy residual', exact(s.energyResidual)],
    ['worst cycle identity', exact(s.worstIdentityResidual)], ['kinetic energy at the end', `${exact(s.kineticEnergyJ)} J`],
  ];
}

function provenanceOf(job: Job): [string, string][] {
  return [
    ['job', job.name], ['uid', job.uid], ['owner', job.owner], ['created', utc(job.createTime)],
    ['started', utc(job.startTime)], ['ended', utc(job.endTime)], ['attempt', exact(job.attempt)],
    ['SHA-256 of the scenario', job.specSha256], ['contactd', job.serverVersion], ['revision', job.serverRevision],
  ];
}

/** The spec as a page of YAML. */
async function yamlOf(job: Job): Promise<string> {
  const {stringify} = await import('yaml');
  const {spec} = job;
  if (spec.case === 'scenario') return stringify(toJson(ScenarioSchema, spec.value, {useProtoFieldName: true}));
  return spec.case === 'sweep' ? stringify(toJson(SweepSchema, spec.value, {useProtoFieldName: true})) : '';
}

function Files({job}: {job: Job}) {
  const [busy, setBusy] = useState('');
  const [error, setError] = useState('');
  if (job.artifacts.length === 0) return null;
  const read = async (artifact: string) => {
    setBusy(artifact);
    setError('');
    try {
      save(`${job.name.replace('jobs/', '')}-${artifact.replaceAll('/', '-')}`, await readArtifact(job.name, artifact));
    } catch (why) {
      setError(`${artifact}: ${explain(why)}`);
    }
    setBusy('');
  };
  return (
    <div><h3>Files</h3><ul class="files">{job.artifacts.slice(0, MOST_FILES).map(({name}) => (
      <li key={name}><button type="button" class="quiet" disabled={busy === name} onClick={() => void read(name)}>{name} ⤓</button></li>))}
    </ul>
      <LeftOut shown={MOST_FILES} all={job.artifacts.length} what="files" way="contactctl artifact list has all" />
      {error && <p class="notice" role="alert">{error}</p>}</div>
  );
}

function Bodies({bodies}: {bodies: FinalBody[]}) {
  const shown = bodies.slice(0, MOST_BODIES);
  return (
    <div><h3>Bodies at the end</h3>
      <div class="scroll" tabIndex={0} role="region" aria-label="Bodies at the end"><table><thead><tr><th>body</th><th class="number">position [m]</th><th class="number">velocity [m/s]</th></tr></thead>
        <tbody>{shown.map((b) => <tr key={b.name}><td>{b.name}</td><td class="number">{exact(b.positionM)}</td><td class="number">{exact(b.velocityMPerS)}</td></tr>)}</tbody></table></div>
      <LeftOut shown={shown.length} all={bodies.length} what="bodies" way="contactctl describe has all" /></div>
  );
}

function Remarks({log}: {log: LogEntry[]}) {
  const shown = log.slice(-MOST_REMARKS);
  return (
    <div><h3>Remarks</h3><ul>{shown.map((entry, i) => (
      <li key={i}>{entry.severity === LogEntry_Severity.WARNING ? '⚠ ' : ''}{entry.message}</li>))}</ul>
      <LeftOut shown={shown.length} all={log.length} what="remarks" way="the newest" /></div>
  );
}

export function Details({run}: {run: RunState}) {
  const job = run.job!;
  const yaml = useAsync(() => yamlOf(job), [job.name, job.spec.case]).value ?? '';
  return (
    <section aria-label="Details" class="details">
      {job.finalBodies.length > 0 && <Bodies bodies={job.finalBodies} />}
      {job.summary && <div><h3>Cost and balances</h3><Pairs pairs={costOf(job.summary)} /></div>}
      <div><h3>Provenance</h3><Pairs pairs={provenanceOf(job)} /></div>
      <Files job={job} />
      {run.log.length > 0 && <Remarks log={run.log} />}
      <div class="wide"><h3>{job.spec.case === 'sweep' ? 'Sweep' : 'Scenario'}</h3><pre tabIndex={0}>{yaml}</pre></div>
    </section>
  );
}
