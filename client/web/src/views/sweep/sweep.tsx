// A parameter study: map, line or parallel coordinates, filling as cells are computed.

import {useMemo} from 'preact/hooks';

import type {SweepCell} from '../../api/generated/contact/v1/event_pb';
import type {Sweep as SweepSpec} from '../../api/generated/contact/v1/scenario_pb';
import {sliceIndex} from '../../model/map_data';
import type {Panel} from '../../model/panel';
import type {RunState} from '../../model/runState';
import {count, exact} from '../../model/numbers';
import {axisName, axisValues, isGrid, metricOf, outcomeOf} from '../../model/sweep';
import {Plot} from '../../plots/plot';
import {save} from '../../ui/save';
import {setQuery} from '../../ui/route';
import {CellDetails, runCell} from './cell';
import {HeatMap} from './heat_map';
import {Parallel} from './parallel';

interface Props {
  id: string;
  run: RunState;
  query: URLSearchParams;
}

function csvOf(sweep: SweepSpec, cells: SweepCell[]): string {
  const head = ['cell', ...sweep.axes.map(axisName), ...sweep.metrics, 'outcome'];
  const rows = cells.map((c) => [c.index, ...c.values.map(exact), ...c.metrics.map(String), outcomeOf(c)]);
  return `${[head, ...rows].map((row) => row.join(',')).join('\n')}\n`;
}

/** A metric over one axis. */
function linePanel(sweep: SweepSpec, cells: SweepCell[], metric: number): Panel {
  const sorted = cells.filter((c) => outcomeOf(c) !== 'failed').sort((a, b) => a.values[0]! - b.values[0]!);
  const curve = {label: sweep.metrics[metric]!, colour: 0, mark: 'linePoints' as const,
    x: sorted.map((c) => c.values[0]!), y: sorted.map((c) => metricOf(c, metric))};
  const missed = sorted.filter((c) => outcomeOf(c) === 'not converged');
  return {id: 'line', title: sweep.metrics[metric]!, xLabel: axisName(sweep.axes[0]!), yLabel: sweep.metrics[metric]!, overTime: true,
    logX: !!sweep.axes[0]!.log, curves: [curve, {label: `${curve.label} ends`, colour: 1, mark: 'end', keyed: false,
      x: missed.map((c) => c.values[0]!), y: missed.map((c) => metricOf(c, metric))}],
    ...(missed.length > 0 ? {note: '×: not converged'} : {})};
}

function Choice({name, query, keyName, options}: {name: string; query: URLSearchParams; keyName: string; options: [string, string][]}) {
  return (
    <label>{name} <select value={query.get(keyName) ?? options[0]?.[0]} onChange={(e) => setQuery({[keyName]: e.currentTarget.value})}>
      {options.map(([value, text]) => <option key={value} value={value}>{text}</option>)}</select></label>
  );
}

export function Sweep({id, run, query}: Props) {
  const spec = run.job!.spec;
  const sweep = spec.case === 'sweep' ? spec.value : undefined;
  const cells = useMemo(() => [...run.cells.values()].sort((a, b) => a.index - b.index), [run.cells.size]);
  if (!sweep) return null;
  const axes = sweep.axes.map((axis) => ({name: axisName(axis), values: axisValues(axis)}));
  const sizes = axes.map(({values}) => values.length);
  const grid = isGrid(sweep) && axes.length >= 2;
  const kinds: [string, string][] = [...(grid ? [['map', 'map'] as [string, string]] : []), ...(axes.length === 1 ? [['line', 'line'] as [string, string]] : []), ['parallel', 'parallel coordinates']];
  const kind = query.get('view') ?? kinds[0]![0];
  const metric = Math.min(Number(query.get('metric') ?? 0) || 0, Math.max(sweep.metrics.length - 1, 0));
  const yAxis = Math.min(Number(query.get('y') ?? 0) || 0, axes.length - 1);
  const xAxis = Math.min(Number(query.get('x') ?? (yAxis === 1 ? 0 : 1)) || 0, axes.length - 1);
  const slice = axes.map((_, i) => Number(query.get(`at${i}`) ?? 0) || 0);
  const chosen = query.has('cell') ? Number(query.get('cell')) : undefined;
  const choose = (cell: number) => setQuery({cell: String(cell)});
  const total = run.job?.progress?.cells || run.progress?.cells || sizes.reduce((a, b) => a * b, 1);
  const open = (index: number) => { const cell = run.cells.get(index); if (cell) void runCell(id, sweep, cell); };
  const axisOptions = axes.map(({name}, i): [string, string] => [String(i), name]);
  return (
    <section aria-label="Sweep" data-cells={cells.length}>
      <div class="tools"><h2>{count(cells.length)} of {count(total)} cells</h2>
        {cells.some((c) => outcomeOf(c) !== 'converged') && <span class="soft">{cells.filter((c) => outcomeOf(c) === 'not converged').length} not converged, {cells.filter((c) => outcomeOf(c) === 'failed').length} failed</span>}
        <Choice name="Show" query={query} keyName="view" options={kinds} />
        {sweep.metrics.length > 0 && <Choice name="Metric" query={query} keyName="metric" options={sweep.metrics.map((m, i) => [String(i), m])} />}
        {kind === 'map' && axes.length > 2 && <Choice name="Down" query={query} keyName="y" options={axisOptions} />}
        {kind === 'map' && axes.length > 2 && <Choice name="Across" query={query} keyName="x" options={axisOptions} />}
        {kind === 'map' && axes.map(({name, values}, i) => i !== xAxis && i !== yAxis && (
          <Choice key={name} name={name} query={query} keyName={`at${i}`} options={values.map((v, j) => [String(j), exact(v)])} />))}
        {kind === 'map' && <label><input type="checkbox" checked={query.has('log')} onChange={(e) => setQuery({log: e.currentTarget.checked ? '1' : undefined})} /> log colours</label>}
        <button type="button" onClick={() => save(`${id}-cells.csv`, new Blob([csvOf(sweep, cells)], {type: 'text/csv'}))}>All cells as CSV</button>
      </div>
      {sweep.metrics.length === 0 && <p class="soft">This sweep keeps no metrics; cells show only whether they converged.</p>}
      {kind === 'map' && grid && xAxis !== yAxis && <HeatMap x={axes[xAxis]!} y={axes[yAxis]!} indexAt={sliceIndex(sizes, slice, xAxis, yAxis)}
        cells={run.cells} version={cells.length} metric={metric} metricName={sweep.metrics[metric] ?? 'convergence'} log={query.has('log')} chosen={chosen} choose={choose} open={open} source={`jobs/${id}`} />}
      {kind === 'line' && sweep.metrics.length > 0 && <Plot panel={linePanel(sweep, cells, metric)} source={`jobs/${id}`} height={320} />}
      {kind === 'parallel' && <Parallel names={[...axes.map(({name}) => name), ...sweep.metrics]} axes={axes.length} cells={cells} metric={metric} choose={choose} open={open} chosen={chosen} csv={() => csvOf(sweep, cells)} source={`jobs/${id}`} />}
      {chosen !== undefined && <CellDetails id={id} sweep={sweep} cell={run.cells.get(chosen)} index={chosen} />}
    </section>
  );
}
