// The values that a field has in the cells of a sweep.

import {useState} from 'preact/hooks';

import type {Path} from '../../../model/form/edit';
import type {FormField} from '../../../model/form/fields';
import {dropAxis, rangeOfAxis, setAxis, wrongRange, type AxisRange} from '../../../model/form/sweep_page';
import type {Editing} from './object_fields';

interface Props {
  field: FormField;
  value: unknown;
  path: Path;
  /** Its place among the axes of the page; -1: it is none yet. */
  axis: number;
  editing: Editing;
  close: () => void;
}

/** A range around a value, within that of the field. */
function rangeAround({low = -Infinity, high = Infinity, kind}: FormField, value: unknown): AxisRange {
  const middle = typeof value === 'number' && value !== 0 ? value : NaN;
  const ends = [0.5 * middle, 1.5 * middle].sort((a, b) => a - b).map((end) => Math.min(Math.max(kind === 'integer' ? Math.round(end) : end, low), high));
  const [from = '', to = ''] = ends.map((end) => (Number.isFinite(end) ? String(Number(end.toPrecision(6))) : ''));
  return {spacing: 'linear', low: from, high: to, count: '5', values: ''};
}

export function AxisForm({field, value, path, axis, editing, close}: Props) {
  const axes = (editing.raw as {axes?: unknown[]}).axes ?? [];
  const [range, setRange] = useState(() => (axis >= 0 ? rangeOfAxis(axes[axis]) : rangeAround(field, value)));
  const [told, setTold] = useState('');
  const input = (key: 'low' | 'high' | 'count' | 'values', label: string) => (
    <label>{label} <input value={range[key]} size={key === 'values' ? 24 : 8} inputMode="decimal" onInput={(e) => setRange({...range, [key]: e.currentTarget.value})} /></label>);
  const vary = (event: Event) => {
    event.preventDefault();
    const wrong = wrongRange(range);
    setTold(wrong);
    if (wrong) return;
    editing.change(setAxis(editing.text, path, range), 'axis');
    close();
  };
  return (
    <form class="vary" aria-label={`Values of ${field.name}`} onSubmit={vary}>
      <label>Values <select value={range.spacing} onChange={(e) => setRange({...range, spacing: e.currentTarget.value as AxisRange['spacing']})}>
        <option value="linear">in equal steps</option><option value="log">in equal ratios</option><option value="values">one by one</option></select></label>
      {range.spacing === 'values' ? input('values', 'values') : <>{input('low', 'from')}{input('high', 'to')}{input('count', 'count')}</>}
      <button type="submit" class="primary">{axis >= 0 ? 'Change the axis' : 'Make it an axis'}</button>
      {axis >= 0 && <button type="button" onClick={() => { editing.change(dropAxis(editing.text, axis), 'axis'); close(); }}>No axis</button>}
      {told && <p class="bad" role="alert">{told}</p>}
    </form>
  );
}
