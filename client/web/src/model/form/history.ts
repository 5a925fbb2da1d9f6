// The texts of a page, one after the other, so that each change can be taken back.

/** What was before and, after a step back, what comes again. */
export interface History {
  past: string[];
  text: string;
  future: string[];
  /** Who changed the text last, and when [ms]. */
  by: string;
  at: number;
}

const MOST = 200;        // Steps back.
const ONE_STEP_MS = 800; // Letters that follow each other so fast are one step.

export const begun = (text: string): History => ({past: [], text, future: [], by: '', at: 0});

/** After a change to `text`. Changes by the same one in quick order are one step. */
export function changed(history: History, text: string, by: string, at: number): History {
  if (text === history.text) return history;
  const same = by === history.by && at - history.at < ONE_STEP_MS && history.past.length > 0;
  return {past: same ? history.past : [...history.past, history.text].slice(-MOST), text, future: [], by, at};
}

/** A step back; the same if there is none. */
export function undone({past, text, future, ...rest}: History): History {
  if (past.length === 0) return {past, text, future, ...rest};
  return {past: past.slice(0, -1), text: past.at(-1)!, future: [text, ...future], by: '', at: 0};
}

/** Where the part of `after` ends that is not in `before`: where the cursor belongs. */
export function endOfChange(before: string, after: string): number {
  const most = Math.min(before.length, after.length);
  let start = 0;
  while (start < most && before[start] === after[start]) ++start;
  let tail = 0;
  while (tail < most - start && before.at(-1 - tail) === after.at(-1 - tail)) ++tail;
  return after.length - tail;
}

/** A step forward again. */
export function redone({past, text, future, ...rest}: History): History {
  if (future.length === 0) return {past, text, future, ...rest};
  return {past: [...past, text], text: future[0]!, future: future.slice(1), by: '', at: 0};
}
