// Title, state and what can be done with a job.

import {useEffect, useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain} from '../../api/errors';
import {isFinal} from '../../api/watch';
import type {RunSummary} from '../../api/generated/contact/v1/job_pb';
import {titleOf, type Labels} from '../../model/remarks';
import type {RunState} from '../../model/runState';
import {count} from '../../model/numbers';
import {CopyLink} from '../../ui/copy';
import {go} from '../../ui/route';
import {SaveReport} from '../../ui/save_report';
import {StateBadge} from '../../ui/state_badge';
import {Twice} from '../../ui/twice';
import {elapsed, partOf} from '../elapsed';
import {Remarks} from './remarks';

function Actions({id, ended, onError}: {id: string; ended: boolean; onError: (why: string) => void}) {
  const name = `jobs/${id}`;
  const attempt = (call: Promise<unknown>, then: () => void = () => undefined) =>
    call.then(then, (error: unknown) => onError(explain(error)));
  return (
    <span class="actions">
      <a class="button" href={`/new?from=${id}`}>Run again with changes</a>
      <a class="button" href={`/compare?jobs=${id}`}>Compare</a>
      <CopyLink />
      {ended && <SaveReport jobs={[name]} />}
      {!ended && <Twice key="cancel" first="Cancel run …" then="Cancel for good" stay="Go on" act={() => void attempt(server.cancelJob({name}))} />}
      {ended && <Twice key="delete" first="Delete …" then="Delete for good" stay="Keep" act={() => void attempt(server.deleteJob({name}), () => go('/runs'))} />}
    </span>
  );
}

function cutOf({cyclesCut}: RunSummary): string {
  return cyclesCut > 0 ? ` (${count(cyclesCut)} cut by the end)` : '';
}

export function Header({id, run}: {id: string; run: RunState}) {
  const [error, setError] = useState('');
  const [labels, setLabels] = useState<Labels>(run.job?.labels ?? {});   // Those of the job, or newer.
  const {job, progress} = run;
  const title = (job && titleOf({...job, labels})) || id;
  useEffect(() => { document.title = `${title} · contactd`; }, [title]);
  const ended = isFinal(run.state);
  return (
    <>
      <div class="head">
        <h1 title={job?.title}>{title}</h1>
        <StateBadge state={run.state} convergence={job?.convergence ?? 0} />
        <Actions id={id} ended={ended} onError={setError} />
      </div>
      {error && <p class="notice" role="alert">{error}</p>}
      {!ended && (
        <p class="progress"><progress max={1} value={partOf(progress)} aria-label="progress" />
          {progress && progress.cells === 0 && <span class="soft">{count(progress.steps)} steps, {count(progress.cycles)} cycles, {count(progress.iterations)} corrections</span>}
        </p>
      )}
      {!ended && progress?.busyWith && <p class="soft">busy: {progress.busyWith}</p>}
      {run.message && <p class="notice" role="status">{run.reason}: {run.message}</p>}
      {job && <p class="facts soft">jobs/{id} · {elapsed(job, progress)}{job.summary ? ` · ${count(job.summary.cycles)} cycles${cutOf(job.summary)}, ${count(job.summary.iterations)} corrections of μ, ${count(job.summary.steps)} steps` : ''}</p>}
      {job && <Remarks key={job.name} job={job} onLabels={setLabels} />}
      {(job?.warnings ?? []).map((text) => <p key={text} class="warning"><span aria-hidden="true">⚠</span> {text}</p>)}
    </>
  );
}
