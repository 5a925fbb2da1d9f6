// Fields of a scenario by their paths, such as `contacts[B1-B2].restitution`.

type Json = Record<string, unknown>;

/** The parts of a path: names, and what stands in brackets. */
export function partsOf(path: string): string[] {
  return [...path.matchAll(/([^.[\]]+)|\[([^\]]*)\]/g)].map(([, name, place]) => name ?? `[${place}]`);
}

/** What stands at a path whose brackets hold numbers; undefined if there is nothing. */
export function valueAt(root: unknown, path: string): unknown {
  return partsOf(path).reduce((at, part) => (at as Json | null | undefined)?.[part.replace(/[[\]]/g, '')], root);
}

/** The places of a list that a word in brackets stands for. */
function placesOf(list: unknown[], word: string): number[] {
  if (word === '*') return list.map((_, i) => i);
  if (/^\d+$/.test(word)) return [Number(word)];
  return list.flatMap((entry, i) => {
    const {name, between, wall} = entry as {name?: string; between?: string[]; wall?: unknown};
    const known = name ?? between?.concat(wall ? ['wall'] : []).join('-');
    return known === word ? [i] : [];
  });
}

/** Sets a field in a scenario of the form of a file. */
export function setField(root: Json, path: string, value: unknown): void {
  let places: Json[] = [root];
  const parts = partsOf(path);
  parts.slice(0, -1).forEach((part) => {
    places = places.flatMap((place) => {
      if (part.startsWith('[')) {
        const list = place as unknown as Json[];
        return placesOf(list, part.slice(1, -1)).map((i) => list[i]!).filter(Boolean);
      }
      place[part] ??= {};
      return [place[part] as Json];
    });
  });
  for (const place of places) place[parts.at(-1)!] = value;
}

/** The numbers, words and truths of a value by their paths. */
export function flatten(value: unknown, path = '', into = new Map<string, string>()): Map<string, string> {
  if (Array.isArray(value)) value.forEach((entry, i) => flatten(entry, `${path}[${i}]`, into));
  else if (value !== null && typeof value === 'object') {
    for (const [name, entry] of Object.entries(value)) flatten(entry, path ? `${path}.${name}` : name, into);
  } else if (value !== undefined && value !== null) into.set(path, String(value));
  return into;
}
