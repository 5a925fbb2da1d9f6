// The address holds the whole state of a view: a path and parameters.

import {useEffect, useMemo, useState} from 'preact/hooks';

const listeners = new Set<() => void>();

export interface Route {
  path: string;
  query: URLSearchParams;
  hash: string;
}

function current(): Route {
  return {path: location.pathname, query: new URLSearchParams(location.search), hash: location.hash};
}

/** Goes to an address of the dashboard. */
export function go(address: string, replace = false): void {
  if (address === location.pathname + location.search + location.hash) return;
  history[replace ? 'replaceState' : 'pushState'](null, '', address);
  for (const told of listeners) told();
}

/** Changes parameters of the address; undefined or empty removes one. A list stands there once for each entry. */
export function setQuery(changes: Record<string, string | string[] | undefined>, replace = true): void {
  const query = new URLSearchParams(location.search);
  for (const [key, value] of Object.entries(changes)) {
    query.delete(key);
    for (const entry of [value ?? []].flat()) if (entry) query.append(key, entry);
  }
  const text = query.toString().replaceAll('%2C', ',').replaceAll('%2F', '/').replaceAll('%3A', ':');
  go(`${location.pathname}${text ? `?${text}` : ''}${location.hash}`, replace);
}

/** What `look` finds in the address, as it changes. */
function useAddress<T>(look: () => T): T {
  const [found, setFound] = useState(look);
  useEffect(() => {
    const told = () => setFound(look);
    listeners.add(told);
    addEventListener('popstate', told);
    return () => { listeners.delete(told); removeEventListener('popstate', told); };
  }, []);
  return found;
}

/** The address, as it changes. */
export function useRoute(): Route {
  return useAddress(current);
}

/** The entries of one parameter; who asks for them is not drawn again when others change. */
export function useParameter(name: string): string[] {
  const text = useAddress(() => JSON.stringify(current().query.getAll(name)));
  return useMemo(() => JSON.parse(text) as string[], [text]);
}

/** The parameters without those named: the same object until one of the others changes. */
export function useOthers(query: URLSearchParams, ...names: string[]): URLSearchParams {
  const others = new URLSearchParams([...query].filter(([name]) => !names.includes(name)));
  return useMemo(() => others, [others.toString()]);
}

/** Follows links inside the dashboard without loading the page again. */
export function followLinks(event: MouseEvent): void {
  const link = (event.target as Element).closest?.('a');
  const plain = event.button === 0 && !event.ctrlKey && !event.metaKey && !event.shiftKey && !event.altKey;
  if (!link || !plain || link.target || link.hasAttribute('download')) return;
  if (link.origin !== location.origin || link.hash) return;
  event.preventDefault();
  go(link.pathname + link.search);
  scrollTo(0, 0);
}
