// A form beside the text: the fields of one object of the scenario. The text stays what counts: each change is made in
// it at its place, and what is written there is shown here.

import {useMemo} from 'preact/hooks';
import {parseDocument} from 'yaml';

import {templates} from '../../../api/templates';
import {setAt, type Path} from '../../../model/form/edit';
import {aboutOf} from '../../../model/form/fields';
import {LISTS, newEntry, objectsOf, type ListName} from '../../../model/form/objects';
import {scenarioPath, withBase} from '../../../model/form/sweep_page';
import type {Problem} from '../../../model/scenario_text';
import {ObjectFields, type Editing} from './object_fields';
import './form.css';

interface Props {
  text: string;
  /** Takes a new text; `by` names the field, so that changes of one field are one step back. */
  change: (text: string, by: string) => void;
  problems: Problem[];
  /** The path of the object that is shown, as JSON. */
  chosen: string;
  choose: (path: string) => void;
}

type Json = Record<string, unknown>;

/** What a page says, with its variables as they are written; undefined if it cannot be read. */
function rawOf(text: string): unknown {
  const doc = parseDocument(text);
  return doc.errors.length > 0 ? undefined : doc.toJS() ?? {};
}

const valueAt = (root: unknown, path: Path) => path.reduce<unknown>((at, key) => (at as Json | null | undefined)?.[key], root);

/** A sweep whose scenario is in a file has no fields here until that is brought into the page. */
function Elsewhere({text, base, change}: {text: string; base: unknown; change: Props['change']}) {
  const file = templates[String(base)];
  const made = file === undefined ? undefined : withBase(text, file);
  return (
    <p class="soft">The scenario of this sweep is <code>{String(base ?? 'not there')}</code>.
      {made !== undefined && <> <button type="button" onClick={() => change(made, 'base')}>Bring it into this page</button></>}</p>
  );
}

export function Form({text, change, problems, chosen, choose}: Props) {
  const raw = useMemo(() => rawOf(text), [text]);
  const root = scenarioPath(raw);
  if (raw === undefined) return <section class="form" aria-label="Form"><h2>Form</h2><p class="soft">It waits until the text can be read.</p></section>;
  if (root === undefined) return <section class="form" aria-label="Form"><h2>Form</h2><Elsewhere text={text} base={(raw as Json).base} change={change} /></section>;
  const scenario = valueAt(raw, root);
  const objects = objectsOf(scenario);
  const object = objects.find(({path}) => JSON.stringify(path) === chosen) ?? objects[0]!;
  const edit = (changes: [Path, string | undefined][], by = JSON.stringify(changes[0]![0])) =>
    change(changes.reduce((page, [path, value]) => setAt(page, [...root, ...path], value), text), by);
  const add = (list: ListName) => {
    const entries = valueAt(scenario, [list]);
    const at = Array.isArray(entries) ? entries.length : 0;
    edit([[[list, at], newEntry(scenario, list)]], '');
    choose(JSON.stringify([list, at]));
  };
  const editing: Editing = {text, raw, scenario, problems, edit, change};
  const entry = typeof object.path[1] === 'number';
  return (
    <section class="form" aria-label="Form">
      <div class="tools">
        <label>Form <select aria-label="Object of the form" value={JSON.stringify(object.path)} onChange={(e) => choose(e.currentTarget.value)}>
          {objects.map(({path, label}) => <option key={JSON.stringify(path)} value={JSON.stringify(path)}>{label}</option>)}</select></label>
        {entry && <button type="button" onClick={() => { edit([[object.path, undefined]], ''); choose('[]'); }}>Remove it</button>}
        <span class="group" role="group" aria-label="Add">Add {LISTS.map(({list, one}) => <button key={list} type="button" aria-label={`Add a ${one}`} onClick={() => add(list)}>{one}</button>)}</span>
      </div>
      <p class="soft hint">{aboutOf(object.type).split('\n')[0]!.replace(/:$/, '.')}</p>
      <ObjectFields key={JSON.stringify(object.path)} type={object.type} value={valueAt(scenario, object.path)} path={object.path} editing={editing} />
    </section>
  );
}
