// A job while it runs, and after.

import {useEffect, useRef, useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain} from '../../api/errors';
import type {Link} from '../../api/stream';
import {isFinal, watchJob} from '../../api/watch';
import {emptyRun, takeEvents, takeSnapshot, type RunState} from '../../model/runState';

/** Watches a job. The answer is a new object whenever something came in, at most once a frame. */
export function useRun(id: string): {run: RunState; link: Link} {
  const [run, setRun] = useState<RunState>(emptyRun);
  const [link, setLink] = useState<Link>({state: 'connecting'});
  const latest = useRef<RunState>(run);
  useEffect(() => {
    const name = `jobs/${id}`;
    const control = new AbortController();
    const state = latest.current = emptyRun();
    let frame = 0;
    let fetched = false;
    const show = () => {
      frame = 0;
      if (isFinal(state.state)) fetchJob(true);
      else if (!fetched) fetchJob(false);
      setRun({...state});
    };
    const plan = () => { frame ||= requestAnimationFrame(show); };
    // The stream leaves out what is long; the job has its spec, and its summary once it has ended.
    let done = false;
    const fetchJob = (final: boolean) => {
      if (done) return;
      done = final;
      fetched = true;
      server.getJob({name}, {signal: control.signal}).then((job) => {
        takeSnapshot(state, job);
        if (state.cycles.length === 0) state.cycles = job.cycles;
        if (state.groups.length === 0) state.groups = job.groups;
        plan();
      }, (error: unknown) => {
        done = fetched = false;
        if (!control.signal.aborted) setLink({state: 'waiting', why: explain(error)});
      });
    };
    fetchJob(false);
    void watchJob(name, (job) => { takeSnapshot(state, state.job?.spec.case ? {...job, spec: state.job.spec} : job); plan(); },
      (events) => { takeEvents(state, events); if (events.length > 0) plan(); },
      setLink, control.signal);
    return () => { control.abort(); cancelAnimationFrame(frame); };
  }, [id]);
  return {run, link};
}
