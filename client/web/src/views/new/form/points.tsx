// The points of a table, a row each.

import {fieldsOf, type FormField} from '../../../model/form/fields';
import type {Path} from '../../../model/form/edit';
import {pathText, Typed} from './field';
import type {Editing} from './object_fields';

const MOST_SHOWN = 100;   // Rows; a longer table is measured, and belongs into a file or the text.

interface Props {
  field: FormField;
  value: unknown;
  path: Path;
  editing: Editing;
}

/** A point after the last, as YAML: as far from it as this from the one before, and as high. */
function nextPoint(columns: FormField[], rows: Record<string, unknown>[]): string {
  const [last, before] = [rows.at(-1), rows.at(-2)];
  const numbers = columns.map(({name}, i) => {
    const value = Number(last?.[name] ?? 0);
    const step = i > 0 || last === undefined ? 0 : value - Number(before?.[name] ?? value - 1);
    return `${name}: ${Number((value + step).toPrecision(12))}`;
  });
  return `{${numbers.join(', ')}}`;
}

export function Points({field, value, path, editing}: Props) {
  const columns = fieldsOf(field.type);
  const rows = Array.isArray(value) ? value as Record<string, unknown>[] : [];
  const place = pathText(path);
  const wrong = editing.problems.filter((one) => one.path.replace(/^base\./, '').startsWith(place));
  if (rows.length > MOST_SHOWN) return <p class="row soft">{field.name}: {rows.length} points, which stand in the text</p>;
  return (
    <fieldset>
      <legend title={field.about}>{field.name}</legend>
      {rows.length > 0 && (
        <table class="points">
          <thead><tr>{columns.map(({name, about}) => <th key={name} scope="col" title={about}>{name}</th>)}<th /></tr></thead>
          <tbody>{rows.map((row, i) => (
            <tr key={i}>
              {columns.map((column) => (
                <td key={column.name}><Typed field={column} value={row[column.name]} aria-label={`${column.name} of point ${i + 1}`}
                  commit={(yaml) => editing.edit([[[...path, i, column.name], yaml]])} /></td>))}
              <td><button type="button" class="quiet" aria-label={`Remove point ${i + 1}`} onClick={() => editing.edit([[[...path, i], undefined]])}>✕</button></td>
            </tr>))}</tbody>
        </table>)}
      <button type="button" onClick={() => editing.edit([[[...path, rows.length], nextPoint(columns, rows)]])}>Add a point</button>
      {wrong.map((one) => <p key={one.path + one.text} class="bad">{field.name}{one.path.replace(/^base\./, '').slice(place.length)} {one.text}</p>)}
    </fieldset>
  );
}
