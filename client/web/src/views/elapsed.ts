import type {Job} from '../api/generated/contact/v1/job_pb';
import {seconds} from '../model/numbers';
import {epoch} from '../ui/times';

/** How long a job took, or its progress while it runs. */
export function elapsed(job: Job): string {
  if (job.endTime && job.startTime) return seconds(Math.max(epoch(job.endTime) - epoch(job.startTime), 0));
  const {progress} = job;
  if (!progress) return '';
  const part = progress.cells > 0 ? progress.cellsDone / progress.cells : progress.timeS / progress.endTimeS;
  return Number.isFinite(part) ? `${Math.floor(100 * part)} %` : '';
}
