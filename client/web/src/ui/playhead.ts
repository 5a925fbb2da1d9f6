// The moment that the strip shows; plots mark it with a line. It is no state of the page: it moves
// sixty times a second.

const listeners = new Set<(time: number | undefined) => void>();
let moment: number | undefined;

export function playhead(): number | undefined {
  return moment;
}

export function setPlayhead(time: number | undefined): void {
  moment = time;
  for (const told of listeners) told(time);
}

export function onPlayhead(told: (time: number | undefined) => void): () => void {
  listeners.add(told);
  return () => { listeners.delete(told); };
}
