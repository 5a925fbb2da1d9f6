// What is done with all chosen runs at once.

import {useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain} from '../../api/errors';
import type {Job} from '../../api/generated/contact/v1/job_pb';
import {isFinal} from '../../api/watch';
import {Twice} from '../../ui/twice';

/** Calls for one run after the other; tells of those that were refused. */
async function forEach(jobs: Job[], call: (name: string) => Promise<unknown>): Promise<string> {
  const refused: string[] = [];
  for (const {name} of jobs) await call(name).catch((error: unknown) => { refused.push(explain(error)); });
  return refused.length > 0 ? `${refused.length} of ${jobs.length}: ${[...new Set(refused)].join(' ')}` : '';
}

const runs = (n: number) => `${n} ${n === 1 ? 'run' : 'runs'}`;

/** Cancels those of the chosen runs that go on, deletes those that have ended. */
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
      {active.length > 0 && <Twice key={`cancel ${active.length}`} first={`Cancel ${runs(active.length)} …`} then="Cancel them for good" stay="Go on" act={() => void cancel()} />}
      {ended.length > 0 && <Twice key={`delete ${ended.length}`} first={`Delete ${runs(ended.length)} …`} then="Delete them for good" stay="Keep" act={() => void remove()} />}
      {error && <span role="alert">{error}</span>}
    </>
  );
}
