// Where in a page a body or contact is.

import {parseDocument} from 'yaml';

import type {Path} from './edit';
import {entryOfContact} from './objects';
import {scenarioPath} from './sweep_page';

/** The path of the entry, from the scenario on; undefined if the page does not have it. */
export function placeOf(text: string, list: 'bodies' | 'contacts', name: string): Path | undefined {
  const doc = parseDocument(text);
  const raw = doc.errors.length > 0 ? undefined : doc.toJS() as Record<string, unknown> | null;
  const root = scenarioPath(raw);
  if (!root) return undefined;
  const scenario = (root.length > 0 ? raw!.base : raw) as {bodies?: {name?: string}[]} | null;
  const at = list === 'contacts' ? entryOfContact(scenario, name) : (scenario?.bodies ?? []).findIndex((body) => body?.name === name);
  return at < 0 ? undefined : [list, at];
}
