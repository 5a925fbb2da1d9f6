// How far measurements are from a run, as contactctl tells it.

import type {Range, Row} from '../../../model/measured/comparison';
import {compact, count, exact, short} from '../../../model/numbers';
import {setQuery} from '../../../ui/route';

const DIGITS = 4;         // As contactctl has them.
const SHIFT_DIGITS = 6;

const relative = ({rms, measuredPeak}: Row) => (measuredPeak === 0 ? '–' : `${short(100 * rms / Math.abs(measuredPeak), 3)} %`);

/** The shift of the clock: the one that was found, or one that is given. */
export function Shift({shift, set, within: [low, high], found}: {shift: number; set: number | undefined; within: Range; found: boolean}) {
  const change = (changes: Record<string, string | undefined>) => setQuery({shift: undefined, ...changes});
  return (
    <>
      <label>Simulated time − measured time [s] <input type="number" step="any" size={12} value={set === undefined ? Number(shift.toPrecision(9)) : set}
        onChange={(e) => change({shift: e.currentTarget.value || '0'})} /></label>
      <span class="group" role="group" aria-label="Where the shift is looked for">fitted between
        <input type="number" step="any" size={9} aria-label="least shift [s]" value={low} onChange={(e) => change({within: `${e.currentTarget.value}:${high}`})} /> and
        <input type="number" step="any" size={9} aria-label="largest shift [s]" value={high} onChange={(e) => change({within: `${low}:${e.currentTarget.value}`})} />
        {set !== undefined && <button type="button" onClick={() => change({})}>Fit it</button>}</span>
      {!found && <span class="bad" role="alert">at no shift half of the measured points lie within the run</span>}
    </>
  );
}

export function Tolerances({query}: {query: URLSearchParams}) {
  return (
    <>
      <label>relative tolerance <input size={6} value={query.get('rel') ?? '0.05'} onChange={(e) => setQuery({rel: e.currentTarget.value})} /></label>
      <label>absolute <input size={6} value={query.get('abs') ?? '0'} onChange={(e) => setQuery({abs: e.currentTarget.value})} /></label>
    </>
  );
}

function Signal({row}: {row: Row}) {
  const number = (value: number) => <td class="number" title={exact(value)}>{compact(value, DIGITS)}</td>;
  const none = row.points === 0;
  return (
    <tr data-signal={row.channel}>
      <td class="name">{row.channel} [{row.unit}]</td>
      <td class="number">{count(row.points)}{row.outside > 0 && ` of ${count(row.points + row.outside)}`}</td>
      {number(row.rms)}<td class="number">{none ? '–' : relative(row)}</td>
      {number(row.largest)}{number(row.largestTime)}{number(row.measuredPeak)}{number(row.simulatedPeak)}{number(row.allowed)}
      <td class={row.holds ? 'good' : 'bad'}>{row.holds ? '✓ ok' : none ? '✗ no point in the run' : '✗ differs'}</td>
    </tr>
  );
}

export function Verdict({rows, shift}: {rows: Row[]; shift: number}) {
  const differing = rows.filter(({holds}) => !holds).length;
  return (
    <>
      <p role="status"><span class={`badge ${differing > 0 ? 'warn' : 'good'}`}>{differing > 0 ? `✗ ${differing} of ${rows.length} not within tolerance` : '✓ within tolerance'}</span>
        {' '}simulated time = measured time {shift < 0 ? '−' : '+'} <span title={exact(shift)} data-shift={shift}>{compact(Math.abs(shift), SHIFT_DIGITS)}</span> s</p>
      <div class="scroll" tabIndex={0} role="region" aria-label="Deviations from the run"><table>
        <thead><tr><th>signal</th><th class="number">points</th><th class="number">rms</th><th class="number">rms of peak</th><th class="number">largest</th><th class="number">at [s]</th>
          <th class="number">measured peak</th><th class="number">simulated peak</th><th class="number">allowed</th><th>verdict</th></tr></thead>
        <tbody>{rows.map((row) => <Signal key={row.channel} row={row} />)}</tbody>
      </table></div>
    </>
  );
}
