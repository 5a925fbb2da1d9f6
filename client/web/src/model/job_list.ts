// The list of jobs: newest first, kept while changes come in.

import {Job_Convergence, Job_State, type Job} from '../api/generated/contact/v1/job_pb';
import type {WatchJobsResponse} from '../api/generated/contact/v1/job_service_pb';
import {epoch} from '../ui/times';
import {PIN, titleOf} from './remarks';

/** A number of a finished run that tells how good or dear it was. */
export interface Metric {
  id: string;
  label: string;
  of: (job: Job) => number | undefined;
}

const summary = (id: string, label: string, of: (s: NonNullable<Job['summary']>) => bigint | number): Metric =>
  ({id, label, of: (job) => (job.summary ? Number(of(job.summary)) : undefined)});

/** Smaller is better in all of them. */
export const METRICS: Metric[] = [
  summary('iterations', 'iterations', (s) => s.iterations),
  summary('cycles', 'cycles', (s) => s.cycles),
  summary('not_converged', 'not converged', (s) => s.cyclesNotConverged + s.cyclesInfeasible),
  summary('energy', 'energy residual', (s) => s.energyResidual),
  summary('identity', 'cycle identity', (s) => s.worstIdentityResidual),
  summary('wall', 'wall time [s]', (s) => s.wallTimeS),
  summary('steps', 'steps', (s) => s.steps),
];

/** The least value of a metric among runs that converged; undefined if fewer than two can be told apart. */
export function bestOf(jobs: Job[], {of}: Metric): number | undefined {
  const values = jobs.filter(({convergence}) => convergence === Job_Convergence.FULL).map(of).filter((value) => value !== undefined);
  return values.length > 1 && new Set(values).size > 1 ? Math.min(...values) : undefined;
}

/** Jobs by name. `stale` holds those of before a new snapshot, until it is complete. */
export class JobList {
  private jobs = new Map<string, Job>();
  private stale = new Set<string>();
  complete = false;

  /** A snapshot begins: what it does not hold is gone. */
  begin(): void {
    this.stale = new Set(this.jobs.keys());
    this.complete = false;
  }

  take(change: WatchJobsResponse): void {
    for (const job of change.jobs) {
      this.jobs.set(job.name, job);
      this.stale.delete(job.name);
    }
    for (const name of change.gone) this.jobs.delete(name);
    if (!change.snapshotComplete || this.complete) return;
    for (const name of this.stale) this.jobs.delete(name);
    this.complete = true;
  }

  /** Newest first. */
  sorted(): Job[] {
    const born = (job: Job) => (job.createTime ? epoch(job.createTime) : 0);
    return [...this.jobs.values()].map((job) => ({job, at: born(job)}))
      .sort((a, b) => b.at - a.at || (a.job.name < b.job.name ? 1 : -1)).map(({job}) => job);
  }
}

export const NOT_CONVERGED = 'NOT_CONVERGED';

/** True if all words are in the title, the name, the note or a label of the job. */
export function matches(job: Job, words: string): boolean {
  const text = [titleOf(job), job.title, job.name, job.note, ...Object.entries(job.labels).map(([k, v]) => `${k}=${v}`)]
    .join(' ').toLowerCase();
  return words.toLowerCase().split(/\s+/).every((word) => text.includes(word));
}

/** What the server is not asked for: it has no filter of words, times and convergence. */
export interface Choice {
  words: string;
  state: string;
  /** Moments; empty or wrong ones choose nothing. */
  after: string;
  before: string;
}

/** The jobs of a choice. */
export function chosenOf(jobs: Job[], {words, state, after, before}: Choice): Job[] {
  const [from, to] = [after, before].map((text) => Date.parse(text) / 1000) as [number, number];
  return jobs.filter((job) => {
    const born = job.createTime ? epoch(job.createTime) : 0;
    return !(born < from) && !(born >= to) && (!words || matches(job, words))
      && (state !== NOT_CONVERGED || job.convergence === Job_Convergence.PARTIAL);
  });
}

/** The label keys of jobs, by which they are grouped. */
export const labelKeys = (jobs: Job[]): string[] => [...new Set(jobs.flatMap(({labels}) => Object.keys(labels)))].filter((key) => key !== PIN).sort();

export const isPinned = ({labels}: Job): boolean => PIN in labels;

/** What a job has in common with the others of its group: its title, or a label, as in `label:law`; or that it is pinned. */
export function groupOf(job: Job, by: string): string {
  const key = by.replace('label:', '');
  if (isPinned(job)) return 'pinned';
  return by === 'title' ? titleOf(job) || 'no title' : `${key} ${job.labels[key] ?? '–'}`;
}

/** Pinned jobs, then those of a group beside each other, in the order of groups' names. */
export function grouped(jobs: Job[], by: string): Job[] {
  const [first, others] = [jobs.filter(isPinned), jobs.filter((job) => !isPinned(job))];
  return [...first, ...(by ? others.sort((a, b) => groupOf(a, by).localeCompare(groupOf(b, by), undefined, {numeric: true})) : others)];
}

/** The states that a choice stands for. */
export function statesOf(choice: string): Job_State[] {
  if (choice === NOT_CONVERGED) return [Job_State.SUCCEEDED];
  const found = Job_State[choice.toUpperCase() as keyof typeof Job_State];
  return found ? [found] : [];
}

/** `key=value` pairs, as far as they are complete. */
export function labelsOf(text: string): Record<string, string> {
  return Object.fromEntries(text.split(/[\s,]+/).map((pair) => pair.split('='))
    .filter((pair): pair is [string, string] => pair.length === 2 && !!pair[0] && !!pair[1]));
}
