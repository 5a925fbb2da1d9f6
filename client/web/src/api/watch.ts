// What happens to jobs, as it happens.

import {Job_State, type Job} from './generated/contact/v1/job_pb';
import type {Event} from './generated/contact/v1/event_pb';
import type {WatchJobsResponse} from './generated/contact/v1/job_service_pb';
import {server} from './client';
import {follow, type Link} from './stream';

/** All kinds of events but the trajectory, which GetSeries gives thinned. */
const KINDS = ['state_changed', 'log_entry', 'iteration', 'group_growth', 'cycle', 'group',
  'attempt_started', 'progress', 'sweep_cell'];
const BOOKMARK = {seconds: 5n, nanos: 0};

/** True if a job in the state will not change any more. */
export function isFinal(state: Job_State): boolean {
  return state >= Job_State.SUCCEEDED;
}

/** Watches one job to its end, from the last sequence received on after each break of the link. */
export function watchJob(
  name: string, onSnapshot: (job: Job) => void, onEvents: (events: Event[]) => void,
  onLink: (link: Link) => void, signal: AbortSignal,
): Promise<void> {
  let afterSequence = 0n;
  return follow(
    (own) => server.watchJob({name, afterSequence, kinds: KINDS, bookmarkInterval: BOOKMARK},
      {signal: own}),
    (message) => {
      if (message.snapshot) onSnapshot(message.snapshot);
      const fresh = message.events.filter(({sequence, payload}) =>
        sequence > afterSequence || sequence === 0n || payload.case === 'bookmark');
      for (const {sequence} of fresh) if (sequence > afterSequence) afterSequence = sequence;
      onEvents(fresh);
      return fresh.some(({payload}) =>
        payload.case === 'stateChanged' && isFinal(payload.value.state));
    }, onLink, signal);
}

/** Watches all jobs that match. `begin` is called before each snapshot. */
export function watchJobs(
  filter: {states: Job_State[]; labels: Record<string, string>}, begin: () => void,
  onChange: (change: WatchJobsResponse) => void, onLink: (link: Link) => void,
  signal: AbortSignal,
): Promise<void> {
  return follow(
    (own) => {
      begin();
      return server.watchJobs({...filter, bookmarkInterval: BOOKMARK}, {signal: own});
    },
    (change) => { onChange(change); return false; }, onLink, signal);
}
