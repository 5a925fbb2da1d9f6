// What a call answers, for a view.

import {useEffect, useState} from 'preact/hooks';

export interface Answer<T> {
  value: T | undefined;
  error: unknown;
}

/** Makes a call whenever its keys change. The last value stays until the next one is there. */
export function useAsync<T>(call: (signal: AbortSignal) => Promise<T>, keys: unknown[]): Answer<T> {
  const [answer, setAnswer] = useState<Answer<T>>({value: undefined, error: undefined});
  useEffect(() => {
    const control = new AbortController();
    call(control.signal).then(
      (value) => { if (!control.signal.aborted) setAnswer({value, error: undefined}); },
      (error: unknown) => { if (!control.signal.aborted) setAnswer((last) => ({...last, error})); });
    return () => control.abort();
  }, keys);
  return answer;
}
