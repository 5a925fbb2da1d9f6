// What the columns of a file are: guessed by their headers, changed by people.

import {TIME, type Known, type Meaning} from '../../../model/measured/signals';
import type {Table} from '../../../model/measured/table';
import {unitFactor, usualUnits} from '../../../model/measured/units';

interface Props {
  table: Table;
  channels: Known[];
  meanings: Meaning[];
  change: (meanings: Meaning[]) => void;
}

export function Columns({table, channels, meanings, change}: Props) {
  const all = [TIME, ...channels];
  const set = (column: number, meaning: Partial<Meaning>) => change(meanings.map((old, i) => {
    if (i === column) return {...old, ...meaning};
    return meaning.channel && old.channel === meaning.channel ? {...old, channel: ''} : old;   // Each channel once.
  }));
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Columns of the file"><table class="columns">
      <thead><tr><th>column</th><th>is</th><th>in</th></tr></thead>
      <tbody>{table.columns.map(({header}, i) => {
        const {channel, unit} = meanings[i]!;
        const si = all.find(({name}) => name === channel)?.unit;
        const what = header || `column ${i + 1}`;
        return (
          <tr key={i}>
            <td class="mono">{what}</td>
            <td><select aria-label={`${what} is`} value={channel} onChange={(e) => set(i, {channel: e.currentTarget.value})}>
              <option value="">left out</option>
              {all.map(({name}) => <option key={name} value={name}>{name}</option>)}</select></td>
            <td>{si !== undefined && <>
              <input aria-label={`unit of ${what}`} list={`units-${i}`} size={8} value={unit} placeholder={si} spellcheck={false} autocomplete="off"
                aria-invalid={unit !== '' && unitFactor(unit, si) === undefined} onInput={(e) => set(i, {unit: e.currentTarget.value.trim()})} />
              <datalist id={`units-${i}`}>{usualUnits(si).map((usual) => <option key={usual} value={usual} />)}</datalist></>}</td>
          </tr>);
      })}</tbody>
    </table></div>
  );
}
