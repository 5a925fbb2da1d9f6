// Streams that go on after any end: they wait a little longer after each failure and begin again.

import {explain, passes} from './errors';

/** How a stream is: `live`, or why it waits. */
export type Link = {state: 'connecting' | 'live'} | {state: 'waiting' | 'lost'; why: string};

const SILENCE_MS = 20_000;   // Twice the interval of bookmarks: the server is gone.
const FIRST_WAIT_MS = 200;
const LONGEST_WAIT_MS = 3_000;

function pause(ms: number, signal: AbortSignal): Promise<void> {
  return new Promise((resolve) => {
    const timer = setTimeout(resolve, ms);
    signal.addEventListener('abort', () => { clearTimeout(timer); resolve(); }, {once: true});
  });
}

/** Reads one stream to its end; breaks it off if it is silent for too long. */
async function readOnce<T>(
  open: (signal: AbortSignal) => AsyncIterable<T>, take: (message: T) => boolean,
  signal: AbortSignal,
): Promise<boolean> {
  const own = new AbortController();
  const stop = () => own.abort();
  signal.addEventListener('abort', stop, {once: true});
  let timer = setTimeout(stop, SILENCE_MS);
  try {
    for await (const message of open(own.signal)) {
      clearTimeout(timer);
      timer = setTimeout(stop, SILENCE_MS);
      if (take(message)) return true;
    }
    return false;
  } finally {
    clearTimeout(timer);
    signal.removeEventListener('abort', stop);
    own.abort();
  }
}

/**
 * Opens a stream again and again until `take` says that it is complete, the signal aborts, or an
 * error comes that does not pass.
 */
export async function follow<T>(
  open: (signal: AbortSignal) => AsyncIterable<T>, take: (message: T) => boolean,
  onLink: (link: Link) => void, signal: AbortSignal,
): Promise<void> {
  for (let tries = 0; !signal.aborted; ++tries) {
    try {
      const complete = await readOnce(open, (message) => {
        if (tries >= 0) onLink({state: 'live'});
        tries = -1;
        return take(message);
      }, signal);
      if (complete || signal.aborted) return;
    } catch (error) {
      if (signal.aborted) return;
      const why = explain(error);
      onLink({state: passes(error) ? 'waiting' : 'lost', why});
      if (!passes(error)) return;
    }
    await pause(Math.min(FIRST_WAIT_MS * 2 ** Math.max(tries, 0), LONGEST_WAIT_MS), signal);
  }
}
