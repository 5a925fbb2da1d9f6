// A parameter study: map, line or parallel coordinates, filling as cells are computed.

import {useMemo, useState} from 'preact/hooks';

import {explain} from '../../api/errors';
import type {SweepCell} from '../../api/generated/contact/v1/event_pb';
import type {Sweep as SweepSpec} from '../../api/generated/contact/v1/scenario_pb';
import {planeOf, sliceIndex} from '../../model/map_data';
import {csvField} from '../../model/panel';
import type {RunState} from '../../model/runState';
import {count, exact} from '../../model/numbers';
import {axisName, axisValues, isGrid, metricOf, outcomeOf, unknownsOf} from '../../model/sweep';
import {axisLabel, metricLabel} from '../../model/sweep_labels';
import {typeset} from '../../model/units';
import {save} from '../../ui/save';
import {setQuery} from '../../ui/route';
import {CellDetails, runCell} from './cell';
import {HeatMap} from './heat_map';
import {Line} from './line';
import {Parallel} from './parallel';

interface Props {
  id: string;
  run: RunState;
  query: URLSearchParams;
}

function csvOf(sweep: SweepSpec, cells: SweepCell[]): string {
  const head = ['cell', ...sweep.axes.map(axisName), ...sweep.metrics, 'outcome', 'unknown'].map(csvField);
  const rows = cells.map((c) => [c.index, ...c.values.map(exact), ...c.metrics.map((_, i) => metricOf(c, i)), outcomeOf(c), unknownsOf(c, sweep.metrics)]);
  return `${[head, ...rows].map((row) => row.join(',')).join('\n')}\n`;
}

function Choice({name, value, keyName, options}: {name: string; value: string; keyName: string; options: [string, string][]}) {
  return (
    <label>{name} <select value={value} onChange={(e) => setQuery({[keyName]: e.currentTarget.value})}>
      {options.map(([value, text]) => <option key={value} value={value}>{text}</option>)}</select></label>
  );
}

export function Sweep({id, run, query}: Props) {
  const spec = run.job!.spec;
  const sweep = spec.case === 'sweep' ? spec.value : undefined;
  const cells = useMemo(() => [...run.cells.values()].sort((a, b) => a.index - b.index), [run.cells.size]);
  const [error, setError] = useState('');
  if (!sweep) return null;
  const axes = sweep.axes.map((axis, i) => ({name: typeset(axisLabel(sweep, i)), values: axisValues(axis)}));
  const metrics = sweep.metrics.map((metric) => typeset(metricLabel(metric)));
  const sizes = axes.map(({values}) => values.length);
  const grid = isGrid(sweep) && axes.length >= 2;
  const kinds: [string, string][] = [...(grid ? [['map', 'map'] as [string, string]] : []), ...(axes.length === 1 ? [['line', 'line'] as [string, string]] : []), ['parallel', 'parallel coordinates']];
  const kind = query.get('view') ?? kinds[0]![0];
  const metric = Math.min(Number(query.get('metric') ?? 0) || 0, Math.max(sweep.metrics.length - 1, 0));
  const {down, across} = planeOf(axes.length, Number(query.get('y') ?? 0), Number(query.get('x') ?? 0));
  const slice = axes.map((_, i) => Number(query.get(`at${i}`) ?? 0) || 0);
  const chosen = query.has('cell') ? Number(query.get('cell')) : undefined;
  const choose = (cell: number) => setQuery({cell: String(cell)});
  const total = run.job?.progress?.cells || run.progress?.cells || sizes.reduce((a, b) => a * b, 1);
  const open = (index: number) => {
    const cell = run.cells.get(index);
    setError('');
    if (cell) runCell(id, sweep, cell).catch((why: unknown) => setError(explain(why)));
  };
  const axisOptions = axes.map(({name}, i): [string, string] => [String(i), name]);
  return (
    <section aria-label="Sweep" data-cells={cells.length}>
      <div class="tools"><h2>{count(cells.length)} of {count(total)} cells</h2>
        {cells.some((c) => outcomeOf(c) !== 'converged') && <span class="soft">{cells.filter((c) => outcomeOf(c) === 'not converged').length} not converged, {cells.filter((c) => outcomeOf(c) === 'failed').length} failed</span>}
        <Choice name="Show" value={kind} keyName="view" options={kinds} />
        {sweep.metrics.length > 0 && <Choice name="Metric" value={String(metric)} keyName="metric" options={metrics.map((m, i) => [String(i), m])} />}
        {kind === 'map' && axes.length > 2 && <Choice name="Down" value={String(down)} keyName="y" options={axisOptions} />}
        {kind === 'map' && axes.length > 2 && <Choice name="Across" value={String(across)} keyName="x" options={axisOptions.filter((_, i) => i !== down)} />}
        {kind === 'map' && axes.map(({name, values}, i) => i !== across && i !== down && (
          <Choice key={name} name={name} value={String(slice[i])} keyName={`at${i}`} options={values.map((v, j) => [String(j), exact(v)])} />))}
        {kind === 'map' && <label><input type="checkbox" checked={query.has('log')} onChange={(e) => setQuery({log: e.currentTarget.checked ? '1' : undefined})} /> log colours</label>}
        {kind === 'map' && <label><input type="checkbox" checked={query.has('contours')} onChange={(e) => setQuery({contours: e.currentTarget.checked ? '1' : undefined})} /> contours</label>}
        <button type="button" onClick={() => save(`${id}-cells.csv`, new Blob([csvOf(sweep, cells)], {type: 'text/csv'}))}>All cells as CSV</button>
      </div>
      {error && <p class="notice" role="alert">{error}</p>}
      {sweep.metrics.length === 0 && <p class="soft">This sweep keeps no metrics; cells show only whether they converged.</p>}
      {kind === 'map' && grid && <HeatMap x={axes[across]!} y={axes[down]!} indexAt={sliceIndex(sizes, slice, across, down)}
        cells={run.cells} version={cells.length} metric={metric} metricName={metrics[metric] ?? 'convergence'} log={query.has('log')} contours={query.has('contours')} chosen={chosen} choose={choose} open={open} source={`jobs/${id}`} />}
      {kind === 'line' && sweep.metrics.length > 0 && <Line sweep={sweep} cells={cells} metric={metric} chosen={chosen} choose={choose} open={open} source={`jobs/${id}`} />}
      {kind === 'parallel' && <Parallel names={[...axes.map(({name}) => name), ...metrics]} axes={axes.length} cells={cells} metric={metric} choose={choose} open={open} chosen={chosen} csv={(some) => csvOf(sweep, some)} source={`jobs/${id}`} />}
      {chosen !== undefined && <CellDetails id={id} sweep={sweep} cell={run.cells.get(chosen)} index={chosen} />}
    </section>
  );
}
