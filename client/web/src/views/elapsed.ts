import type {Job, Progress} from '../api/generated/contact/v1/job_pb';
import {seconds} from '../model/numbers';
import {epoch} from '../ui/times';

/** The part of a job that is done, from 0 to 1. */
export function partOf(progress: Progress | undefined): number {
  if (!progress) return 0;
  const part = progress.cells > 0 ? progress.cellsDone / progress.cells : progress.timeS / progress.endTimeS;
  return Number.isFinite(part) ? part : 0;
}

/** How long a job took, or its progress while it runs. */
export function elapsed(job: Job, progress = job.progress): string {
  if (job.endTime && job.startTime) return seconds(Math.max(epoch(job.endTime) - epoch(job.startTime), 0));
  return progress ? `${Math.floor(100 * partOf(progress))} %` : '';
}
