// The curves that are hidden; they stand in the address, each as `hide=PLOT:CURVE`.

import {useMemo} from 'preact/hooks';

import {setQuery, useParameter} from './route';

/** The hidden curves of a plot, and how to change them. */
export function useHidden(plot: string): [Set<string>, (hidden: Set<string>) => void] {
  const all = useParameter('hide');
  const mark = `${plot}:`;
  const own = all.filter((entry) => entry.startsWith(mark));
  const hidden = useMemo(() => new Set(own.map((entry) => entry.slice(mark.length))), [own.join('\n')]);
  const change = (next: Set<string>) =>
    setQuery({hide: [...all.filter((entry) => !entry.startsWith(mark)), ...[...next].map((label) => mark + label)]});
  return [hidden, change];
}
