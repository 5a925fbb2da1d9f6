// What is done with all chosen runs at once.

import {useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain} from '../../api/errors';
import type {Job} from '../../api/generated/contact/v1/job_pb';
import {isFinal} from '../../api/watch';
import {isPinned} from '../../model/job_list';
import {labelChangeOf, PIN, relabelled, type LabelChange} from '../../model/remarks';
import {Twice} from '../../ui/twice';

/** Calls for one run after the other; tells of those that were refused. */
async function forEach(jobs: Job[], call: (name: string) => Promise<unknown>): Promise<string> {
  const refused: string[] = [];
  for (const {name} of jobs) await call(name).catch((error: unknown) => { refused.push(explain(error)); });
  return refused.length > 0 ? `${refused.length} of ${jobs.length}: ${[...new Set(refused)].join(' ')}` : '';
}

/** Changes labels of runs. */
function relabel(jobs: Job[], change: Omit<LabelChange, 'wrong'>): Promise<string> {
  const byName = new Map(jobs.map((job) => [job.name, job]));
  return forEach(jobs, (name) => {
    const job = byName.get(name)!;
    return server.updateJob({job: {name, labels: relabelled(job, change)}, updateMask: {paths: ['labels']}, expectedUid: job.uid});
  });
}

const runs = (n: number) => `${n} ${n === 1 ? 'run' : 'runs'}`;

/** Gives labels to all of them and takes others away; what is typed stays until it is done. */
function Label({jobs, onError}: {jobs: Job[]; onError: (why: string) => void}) {
  const [text, setText] = useState<string>();
  const label = async (event: Event) => {
    event.preventDefault();
    const change = labelChangeOf(text!);
    if (change.wrong.length > 0) { onError(`${change.wrong.join(', ')}: write key=value to give a label, key- to take one away`); return; }
    const why = await relabel(jobs, change);
    onError(why);
    if (!why) setText(undefined);
  };
  if (text === undefined) return <button type="button" onClick={() => setText('')}>Label {runs(jobs.length)} …</button>;
  return (
    <form class="group" aria-label="Labels of the chosen runs" onSubmit={(e) => void label(e)}>
      <label>Labels <input value={text} autofocus placeholder="key=value, key-, title=name" spellcheck={false} onInput={(e) => setText(e.currentTarget.value)} /></label>
      <button type="submit" class="primary" disabled={text.trim() === ''}>Label {runs(jobs.length)}</button>
      <button type="button" onClick={() => setText(undefined)}>Leave</button>
    </form>
  );
}

/** Keeps runs at the top of the list; those that are there all go back to their places. */
function Pin({jobs, onError}: {jobs: Job[]; onError: (why: string) => void}) {
  const all = jobs.every(isPinned);
  const pin = async () => onError(await relabel(jobs, all ? {set: {}, removed: [PIN]} : {set: {[PIN]: '1'}, removed: []}));
  return <button type="button" onClick={() => void pin()}>{all ? 'Unpin' : 'Pin'} {runs(jobs.length)}</button>;
}

/** Pins and labels the chosen runs, cancels those that go on, deletes those that have ended. */
export function Bulk({jobs, gone}: {jobs: Job[]; gone: (jobs: Job[]) => void}) {
  const [error, setError] = useState('');
  const ended = jobs.filter(({state}) => isFinal(state));
  const active = jobs.filter(({state}) => !isFinal(state));
  const cancel = async () => setError(await forEach(active, (name) => server.cancelJob({name})));
  const remove = async () => {
    setError(await forEach(ended, (name) => server.deleteJob({name})));
    gone(ended);
  };
  return (
    <>
      {jobs.length > 0 && <><Pin jobs={jobs} onError={setError} /><Label jobs={jobs} onError={setError} /></>}
      {active.length > 0 && <Twice key={`cancel ${active.length}`} first={`Cancel ${runs(active.length)} …`} then="Cancel them for good" stay="Go on" act={() => void cancel()} />}
      {ended.length > 0 && <Twice key={`delete ${ended.length}`} first={`Delete ${runs(ended.length)} …`} then="Delete them for good" stay="Keep" act={() => void remove()} />}
      {error && <span role="alert">{error}</span>}
    </>
  );
}
