// What people say of runs: labels and a note.

import type {Job} from '../api/generated/contact/v1/job_pb';

export type Labels = Record<string, string>;

export const MOST_NOTE = 1000;   // Characters, see Job.note.

/** A change of labels as it is typed: `key=value` gives one, `key-` takes one away. */
export interface LabelChange {
  set: Labels;
  removed: string[];
  /** What is neither. */
  wrong: string[];
}

export function labelChangeOf(text: string): LabelChange {
  const words = text.split(/[\s,]+/).filter(Boolean);
  const pairs = words.filter((word) => /^[^=]+=/.test(word)).map((word) => [word.slice(0, word.indexOf('=')), word.slice(word.indexOf('=') + 1)]);
  return {
    set: Object.fromEntries(pairs) as Labels,
    removed: words.filter((word) => /^[^=]+-$/.test(word)).map((word) => word.slice(0, -1)),
    wrong: words.filter((word) => !/^[^=]+(=|-$)/.test(word)),
  };
}

/** The labels of a run after a change. */
export function relabelled({labels}: Pick<Job, 'labels'>, {set, removed}: Omit<LabelChange, 'wrong'>): Labels {
  return {...Object.fromEntries(Object.entries(labels).filter(([key]) => !removed.includes(key))), ...set};
}

export const TITLE = 'title';   // The label that stands for the title of the scenario, which cannot be changed,
export const PIN = 'pin';       // and that of runs which the list has first.

/** What a run is called. */
export const titleOf = ({labels, title}: Pick<Job, 'labels' | 'title'>): string => labels[TITLE] || title;

/** The labels that are shown as such. */
export const plainLabels = (labels: Labels): [string, string][] => Object.entries(labels).filter(([key]) => key !== TITLE && key !== PIN);

/** Labels as they are typed, in the order of their keys. */
export const labelsText = (labels: Labels): string =>
  Object.entries(labels).filter(([key]) => key !== TITLE).sort(([a], [b]) => (a < b ? -1 : 1)).map(([key, value]) => `${key}=${value}`).join(', ');

/** The beginning of a note, in one line. */
export function noteHint(note: string, most = 60): string {
  const line = note.trim().split('\n')[0]!;
  const letters = [...line];
  return letters.length > most || line !== note.trim() ? `${letters.slice(0, most).join('')} …` : line;
}
