// A job while it runs, and after.

import {useEffect, useRef, useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain, passes} from '../../api/errors';
import type {Link} from '../../api/stream';
import type {Job} from '../../api/generated/contact/v1/job_pb';
import {isFinal, watchJob} from '../../api/watch';
import {emptyRun, takeEvents, takeSnapshot, type RunState} from '../../model/runState';

const SHOW_EVERY_MS = 60;

/** Watches a job. The answer is a new object whenever something came in, but not too often. */
export function useRun(id: string): {run: RunState; link: Link} {
  const [run, setRun] = useState<RunState>(emptyRun);
  const [link, setLink] = useState<Link>({state: 'connecting'});
  const latest = useRef<RunState>(run);
  useEffect(() => {
    const name = `jobs/${id}`;
    const control = new AbortController();
    const state = latest.current = emptyRun();
    let frame = 0;
    let shownAt = 0;
    let fetched = false;
    let whole = false;   // The job as it stays is here: its end, its summary, its bodies.
    const show = () => {
      frame = 0;
      shownAt = performance.now();
      if (isFinal(state.state)) fetchJob(true);
      else if (!fetched) fetchJob(false);
      setRun({...state});
    };
    // The first change is shown at once, more of them so often that the page stays quick.
    const plan = () => {
      if (frame) return;
      const wait = shownAt + SHOW_EVERY_MS - performance.now();
      frame = wait > 0 ? window.setTimeout(show, wait) : requestAnimationFrame(show);
    };
    // The stream leaves out what is long; the job has its spec, and its summary once it has ended.
    let done = false;
    const fetchJob = (final: boolean) => {
      if (done) return;
      done = final;
      fetched = true;
      server.getJob({name}, {signal: control.signal}).then((job) => {
        if (whole) return;
        whole = isFinal(job.state);
        takeSnapshot(state, job);
        if (state.cycles.length === 0) state.cycles = job.cycles;
        if (state.groups.length === 0) state.groups = job.groups;
        plan();
      }, (error: unknown) => {
        done = fetched = false;
        if (!control.signal.aborted) setLink({state: passes(error) ? 'waiting' : 'lost', why: explain(error)});
      });
    };
    fetchJob(false);
    // What comes later than the whole job would only take away from it.
    const takeHeader = (job: Job) => {
      if (!whole) takeSnapshot(state, state.job?.spec.case ? {...job, spec: state.job.spec} : job);
      plan();
    };
    void watchJob(name, takeHeader,
      (events) => { takeEvents(state, events); if (events.length > 0) plan(); },
      setLink, control.signal);
    return () => { control.abort(); clearTimeout(frame); cancelAnimationFrame(frame); };
  }, [id]);
  return {run, link};
}
