// The fields of an object, and of those that it holds.

import type {Path} from '../../../model/form/edit';
import {choicesOf, fieldsOf, type FormField} from '../../../model/form/fields';
import {LISTS} from '../../../model/form/objects';
import type {Problem} from '../../../model/scenario_text';
import {Field, pathText} from './field';
import {Points} from './points';

/** What fields need to change the page. */
export interface Editing {
  text: string;
  raw: unknown;
  scenario: unknown;
  problems: Problem[];
  /** Gives fields values, YAML in one line each, or takes them away. */
  edit: (changes: [Path, string | undefined][]) => void;
  change: (text: string, by: string) => void;
}

interface Props {
  type: string;
  value: unknown;
  path: Path;
  editing: Editing;
}

/** What has a place of its own in the form. */
const SHOWN_BY_THEMSELVES: string[] = [...LISTS.map(({list}) => list), 'solver', 'output'];

function Inner({field, value, path, editing, removable}: {field: FormField; value: unknown; path: Path; editing: Editing; removable: boolean}) {
  if (value === undefined || value === null) {
    return <p class="row"><button type="button" title={field.about} onClick={() => editing.edit([[path, '{}']])}>Give {field.name}</button></p>;
  }
  return (
    <fieldset>
      <legend title={field.about}>{field.name} {removable && <button type="button" class="quiet" aria-label={`Remove ${field.name}`} onClick={() => editing.edit([[path, undefined]])}>✕</button>}</legend>
      <ObjectFields type={field.type} value={value} path={path} editing={editing} />
    </fieldset>
  );
}

export function ObjectFields({type, value, path, editing}: Props) {
  const given = (value ?? {}) as Record<string, unknown>;
  const choices = choicesOf(type);
  const kind = choices.find((name) => name in given) ?? '';
  const wrong = editing.problems.filter((one) => one.path.replace(/^base\./, '') === pathText(path));
  const take = (next: string) => editing.edit([...(kind ? [[[...path, kind], undefined] as [Path, undefined]] : []), [[...path, next], '{}']]);
  return (
    <>
      {wrong.map(({text}) => <p key={text} class="bad">{text}</p>)}
      {choices.length > 0 && (
        <label class="row">kind <select value={kind} onChange={(e) => take(e.currentTarget.value)}>
          {kind === '' && <option value="">choose …</option>}{choices.map((name) => <option key={name}>{name}</option>)}</select></label>)}
      {fieldsOf(type).map((field) => {
        const own = [...path, field.name];
        if (path.length === 0 && SHOWN_BY_THEMSELVES.includes(field.name)) return null;
        if (choices.includes(field.name) && field.name !== kind) return null;
        if (field.kind === 'object') return <Inner key={field.name} field={field} value={given[field.name]} path={own} editing={editing} removable={field.name !== kind} />;
        if (field.kind === 'objects') return <Points key={field.name} field={field} value={given[field.name]} path={own} editing={editing} />;
        return <Field key={field.name} field={field} value={given[field.name]} path={own} editing={editing} />;
      })}
    </>
  );
}
