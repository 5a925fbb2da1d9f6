// What is known of a job while its events come in.

import type {
  Event, GroupGrowth, Iteration, LogEntry, SweepCell,
} from '../api/generated/contact/v1/event_pb';
import {Job_State, type Cycle, type Group, type Job, type Progress} from '../api/generated/contact/v1/job_pb';

export const MOST_ITERATIONS = 50_000;   // Older passes are dropped; plot and table show one episode.

/** The parts of a job; `version` grows with every change. */
export interface RunState {
  version: number;
  job: Job | undefined;
  state: Job_State;
  reason: string;
  message: string;
  attempt: number;
  progress: Progress | undefined;
  /** The newest passes; of `dropped` older ones the last was of the episode `droppedTo`. */
  iterations: Iteration[];
  dropped: number;
  droppedTo: number;
  growths: GroupGrowth[];
  cycles: Cycle[];
  groups: Group[];
  log: LogEntry[];
  cells: Map<number, SweepCell>;
}

export function emptyRun(): RunState {
  return {
    version: 0, job: undefined, state: Job_State.STATE_UNSPECIFIED, reason: '', message: '',
    attempt: 0, progress: undefined, iterations: [], dropped: 0, droppedTo: 0, growths: [], cycles: [], groups: [], log: [],
    cells: new Map(),
  };
}

/** Takes the job as it is when a watch begins. */
export function takeSnapshot(run: RunState, job: Job): void {
  run.job = job;
  run.state = job.state;
  run.reason = job.stateReason;
  run.progress ??= job.progress;
  ++run.version;
}

/** A worker began anew: what came before belongs to an earlier attempt, but for cells. */
function restart(run: RunState, attempt: number): void {
  Object.assign(run, {attempt, iterations: [], dropped: 0, droppedTo: 0, growths: [], cycles: [], groups: []});
}

function takeEvent(run: RunState, {payload}: Event): void {
  switch (payload.case) {
    case 'stateChanged':
      run.state = payload.value.state;
      run.reason = payload.value.stateReason;
      run.message = payload.value.message;
      break;
    case 'attemptStarted': restart(run, payload.value.attempt); break;
    case 'iteration': run.iterations.push(payload.value); break;
    case 'groupGrowth': run.growths.push(payload.value); break;
    case 'cycle': run.cycles.push(payload.value); break;
    case 'group': run.groups.push(payload.value); break;
    case 'logEntry': run.log.push(payload.value); break;
    case 'progress': run.progress = payload.value; break;
    case 'sweepCell': run.cells.set(payload.value.index, payload.value); break;
    default: break;
  }
}

function dropOldest(run: RunState): void {
  const old = run.iterations.splice(0, Math.max(run.iterations.length - MOST_ITERATIONS, 0));
  run.dropped += old.length;
  run.droppedTo = old.at(-1)?.episode ?? run.droppedTo;
}

/** Takes events in order. */
export function takeEvents(run: RunState, events: Event[]): void {
  for (const event of events) takeEvent(run, event);
  dropOldest(run);
  if (events.length > 0) ++run.version;
}
