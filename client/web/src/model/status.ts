// What the statuses of cycles and groups look like and mean.

import {Cycle_Status, type Cycle, type Group} from '../api/generated/contact/v1/job_pb';
import {short} from './numbers';

interface Look {
  sign: string;
  tone: 'good' | 'bad' | 'warn' | 'calm';
  /** What it means, in a sentence. */
  meaning: string;
}

const UNKNOWN: Look = {sign: '!', tone: 'warn', meaning: ''};
const LOOKS: Partial<Record<Cycle_Status, Look>> = {
  [Cycle_Status.CONVERGED]: {sign: '✓', tone: 'good', meaning: 'the group has the restitution asked for'},
  [Cycle_Status.GIVEN_LAW]: {sign: '✓', tone: 'good', meaning: 'μ is given, or follows from a law'},
  [Cycle_Status.SETTLED]: {sign: '✓', tone: 'good', meaning: 'its work is negligible, or the contact rests'},
  [Cycle_Status.RELEASED]: {sign: '✓', tone: 'good', meaning: 'it gives back what was stored before; ε says nothing of it'},
  [Cycle_Status.JUMP]: {sign: '!', tone: 'warn', meaning: 'ε jumps over the one asked for as μ changes'},
  [Cycle_Status.LIMITED]: {sign: '!', tone: 'warn', meaning: 'no μ gives ε, for loads drive or hold the contact'},
  [Cycle_Status.CUT]: {sign: '┤', tone: 'calm', meaning: 'the end of the run cuts it; what that hides is –'},
  [Cycle_Status.UNFINISHED]: {sign: '┤', tone: 'calm', meaning: 'the end of the run cuts it, and no μ was found'},
  [Cycle_Status.INFEASIBLE]: {sign: '✗', tone: 'bad', meaning: 'no μ gives the restitution asked for'},
  [Cycle_Status.NOT_CONVERGED]: {sign: '✗', tone: 'bad', meaning: 'the row misses a bound of a proof; a warning tells which'},
};

/** What stands for a status. */
export function lookOfStatus(status: Cycle_Status): Look {
  return LOOKS[status] ?? UNKNOWN;
}

/** True for what the end of the run cuts. */
export function isCut({status}: {status: Cycle_Status}): boolean {
  return status === Cycle_Status.CUT || status === Cycle_Status.UNFINISHED;
}

/** ε of a cycle; NaN where it says nothing. */
export function restitutionOf({status, restitutionOut}: Cycle): number {
  return status === Cycle_Status.SETTLED || status === Cycle_Status.RELEASED ? NaN : restitutionOut;
}

/** What the search for a μ that does not exist has reached; empty for other groups. */
export function reachedOf(group: Group): string {
  if (![Cycle_Status.JUMP, Cycle_Status.LIMITED, Cycle_Status.INFEASIBLE].includes(group.status)) return '';
  const at = (restitution = NaN, mu = NaN) => `ε ${short(restitution)} at μ = ${short(mu, 6)}`;
  const much = group.tooMuchMu === undefined ? [] : [at(group.tooMuchRestitution, group.tooMuchMu)];
  const little = group.tooLittleMu === undefined ? [] : [at(group.tooLittleRestitution, group.tooLittleMu)];
  return [...much, ...little].join('; ');
}
