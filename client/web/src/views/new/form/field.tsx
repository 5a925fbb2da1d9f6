// One field of the form: what it is, what is wrong with it, and that it may be an axis.

import type {JSX} from 'preact';
import {useEffect, useState} from 'preact/hooks';

import {numberOf, textOf, type Path} from '../../../model/form/edit';
import type {FormField} from '../../../model/form/fields';
import {axisAt} from '../../../model/form/sweep_page';
import {AxisForm} from './axis';
import type {Editing} from './object_fields';

/** A path as messages have it, such as `bodies[0].mass_kg`. */
export const pathText = (path: Path): string =>
  path.reduce<string>((text, part) => (typeof part === 'number' ? `${text}[${part}]` : text ? `${text}.${part}` : part), '');

/** A value as people type it. */
function typedOf(value: unknown): string {
  if (value === undefined || value === null) return '';
  if (typeof value === 'number' && Math.abs(value) >= 1e5) return value.toExponential().replace('e+', 'e');
  return Array.isArray(value) ? value.map(String).join(', ') : typeof value === 'object' ? JSON.stringify(value) : String(value);
}

/** What is typed as YAML; undefined for nothing. */
function yamlOf({kind}: FormField, typed: string): string | undefined {
  if (typed.trim() === '') return undefined;
  if (kind === 'number' || kind === 'integer') return numberOf(typed);
  if (kind === 'numbers' || kind === 'texts') {
    const entry = kind === 'numbers' ? numberOf : (one: string) => textOf(one.trim());
    return `[${typed.split(',').filter((one) => one.trim() !== '').map(entry).join(', ')}]`;
  }
  return kind === 'truth' || kind === 'word' ? typed : textOf(typed);
}

/** An input of a field. What is typed stays while the page is checked. */
export function Typed({field, value, commit, ...rest}: {field: FormField; value: unknown; commit: (yaml: string | undefined) => void} & Omit<JSX.HTMLAttributes<HTMLInputElement>, 'value'>) {
  const shown = typedOf(value);
  const [typed, setTyped] = useState(shown);
  useEffect(() => setTyped(shown), [shown]);
  const store = (text: string) => { if (text !== shown) commit(yamlOf(field, text)); };
  return <input {...rest} value={typed} inputMode={field.kind === 'number' || field.kind === 'integer' ? 'decimal' : undefined} spellcheck={false}
    onInput={(e) => setTyped(e.currentTarget.value)} onChange={(e) => store(e.currentTarget.value)} />;
}

interface Props {
  field: FormField;
  value: unknown;
  path: Path;
  editing: Editing;
}

export function Field({field, value, path, editing}: Props) {
  const shown = typedOf(value);
  const [open, setOpen] = useState(false);
  const place = pathText(path);
  const id = `form-${place.replace(/[^\w]+/g, '-')}`;
  const wrong = editing.problems.filter((one) => one.path.replace(/^base\./, '') === place);
  const commit = (yaml: string | undefined) => editing.edit([[path, yaml]]);
  const common = {id, 'aria-invalid': wrong.length > 0, 'aria-describedby': `${id}-about`};
  const words = field.kind === 'truth' ? [{word: 'true', about: ''}, {word: 'false', about: ''}] : field.words;
  const number = field.kind === 'number' || field.kind === 'integer';
  const axis = number ? axisAt(editing.raw, editing.scenario, path) : -1;
  return (
    <div class="row">
      <label for={id} class={field.required ? 'needed' : ''} title={field.about}>{field.name}</label>
      {words.length > 0
        ? <select {...common} value={shown} onChange={(e) => commit(yamlOf(field, e.currentTarget.value))}>
            <option value="">{field.standard || 'not given'}</option>
            {!words.some(({word}) => word === shown) && shown && <option value={shown}>{shown}</option>}
            {words.map(({word, about}) => <option key={word} value={word} title={about}>{word}</option>)}</select>
        : <Typed {...common} field={field} value={value} placeholder={field.standard} commit={commit} />}
      {number && <button type="button" class="axis" aria-pressed={axis >= 0} aria-expanded={open} aria-label={`axis over ${field.name}`} title="Vary it in a sweep" onClick={() => setOpen(!open)}>axis</button>}
      {wrong.map(({text}) => <p key={text} class="bad">{text}</p>)}
      <p id={`${id}-about`} class="about soft">{field.about}</p>
      {open && <AxisForm field={field} value={value} path={path} axis={axis} editing={editing} close={() => setOpen(false)} />}
    </div>
  );
}
