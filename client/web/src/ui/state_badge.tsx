// The state of a job in a word, a sign and a colour.

import {Job_Convergence, Job_State, type Job} from '../api/generated/contact/v1/job_pb';

interface Look {
  sign: string;
  word: string;
  tone: string;
}

/** What stands for a state. */
export function lookOf(state: Job_State, convergence = Job_Convergence.CONVERGENCE_UNSPECIFIED): Look {
  if (state === Job_State.SUCCEEDED && convergence === Job_Convergence.PARTIAL) {
    return {sign: '◐', word: 'NOT CONVERGED', tone: 'warn'};
  }
  switch (state) {
    case Job_State.QUEUED: return {sign: '◌', word: 'QUEUED', tone: 'calm'};
    case Job_State.RUNNING: return {sign: '▶', word: 'RUNNING', tone: 'live'};
    case Job_State.SUCCEEDED: return {sign: '✓', word: 'SUCCEEDED', tone: 'good'};
    case Job_State.FAILED: return {sign: '✗', word: 'FAILED', tone: 'bad'};
    case Job_State.CANCELLED: return {sign: '⊘', word: 'CANCELLED', tone: 'calm'};
    default: return {sign: '…', word: 'UNKNOWN', tone: 'calm'};
  }
}

export function StateBadge({state, convergence}: Pick<Job, 'state' | 'convergence'>) {
  const {sign, word, tone} = lookOf(state, convergence);
  return <span class={`badge ${tone}`}><span aria-hidden="true">{sign}</span> {word}</span>;
}
