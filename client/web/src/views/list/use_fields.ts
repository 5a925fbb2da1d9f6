// The fields of the runs of a page of the list. The list comes without scenarios; they are asked for when fields are shown.

import {useEffect, useRef, useState} from 'preact/hooks';

import {server} from '../../api/client';
import type {Fields} from '../../model/job_fields';

/** The fields of each run, by name, as they come; all are asked for one after the other while `wanted`. */
export function useFields(names: string[], wanted: boolean): Map<string, Fields> {
  const known = useRef(new Map<string, Fields>());
  const [, show] = useState(0);
  useEffect(() => {
    if (!wanted) return undefined;
    const control = new AbortController();
    const read = async () => {
      const {fieldsOf} = await import('../../model/job_fields');   // The first page does not need what reads scenarios.
      for (const name of names.filter((one) => !known.current.has(one))) {
        if (control.signal.aborted) return;
        const job = await server.getJob({name}, {signal: control.signal}).catch(() => undefined);   // It may be gone by now.
        if (job) known.current.set(name, fieldsOf(job));
      }
      show((n) => n + 1);
    };
    void read();
    return () => control.abort();
  }, [names.join(), wanted]);
  return known.current;
}
