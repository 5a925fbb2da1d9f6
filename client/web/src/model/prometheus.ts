// The text in which a server tells its metrics.

export interface Sample {
  name: string;
  labels: string;
  value: number;
}

export interface Family {
  name: string;
  help: string;
  type: string;
  samples: Sample[];
}

/** The metrics of a page; lines that are none are passed over. */
export function parseMetrics(text: string): Family[] {
  const families = new Map<string, Family>();
  const family = (name: string) => {
    let found = families.get(name);
    if (!found) families.set(name, found = {name, help: '', type: '', samples: []});
    return found;
  };
  for (const line of text.split('\n')) {
    const about = /^# (HELP|TYPE) (\S+) (.*)$/.exec(line);
    if (about) {
      family(about[2]!)[about[1] === 'HELP' ? 'help' : 'type'] = about[3]!;
      continue;
    }
    const sample = /^([a-zA-Z_:][\w:]*)(?:\{(.*)\})? (\S+)/.exec(line);
    if (!sample) continue;
    const base = sample[1]!.replace(/_(bucket|sum|count)$/, '');
    const owner = families.has(base) ? base : sample[1]!;
    family(owner).samples.push({name: sample[1]!, labels: sample[2] ?? '', value: Number(sample[3]!.replace('Inf', 'Infinity'))});
  }
  return [...families.values()].filter(({samples}) => samples.length > 0);
}
