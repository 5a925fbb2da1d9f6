// A metric over the one axis of a sweep; each point is a cell.

import {useMemo} from 'preact/hooks';

import type {SweepCell} from '../../api/generated/contact/v1/event_pb';
import type {Sweep} from '../../api/generated/contact/v1/scenario_pb';
import {exact} from '../../model/numbers';
import type {Curve, Panel} from '../../model/panel';
import {countUnknown, metricOf, metricText, outcomeOf} from '../../model/sweep';
import {axisLabel, metricLabel} from '../../model/sweep_labels';
import {typeset} from '../../model/units';
import {Plot} from '../../plots/plot';
import {keysOver, type Choosing} from './choosing';

interface Props extends Choosing {
  sweep: Sweep;
  cells: SweepCell[];
  metric: number;
  source: string;
}

/** The metric and the axis. */
const namesOf = ({sweep, metric}: Pick<Props, 'sweep' | 'metric'>) => [metricLabel(sweep.metrics[metric]!), axisLabel(sweep, 0)].map(typeset) as [string, string];

/** The cells that have a value, by the value of the axis. */
function pointsOf(cells: SweepCell[]): SweepCell[] {
  return cells.filter((c) => outcomeOf(c) !== 'failed').sort((a, b) => a.values[0]! - b.values[0]!);
}

function linePanel({sweep, metric, chosen}: Props, points: SweepCell[]): Panel {
  const axis = sweep.axes[0]!;
  const [name, xLabel] = namesOf({sweep, metric});
  const curve = (label: string, colour: number, mark: Curve['mark'], of: SweepCell[]): Curve => ({
    label, colour, mark, keyed: mark === 'linePoints', x: of.map((c) => c.values[0]!), y: of.map((c) => metricOf(c, metric))});
  const missed = points.filter((c) => outcomeOf(c) === 'not converged');
  const unknown = countUnknown(points, metric);
  return {
    id: 'line', title: name, xLabel, yLabel: name, overTime: true, logX: !!axis.log,
    curves: [curve(name, 0, 'linePoints', points), curve(`${name} ends`, 1, 'end', missed),
      curve('chosen', 1, 'start', points.filter(({index}) => index === chosen))],
    note: `o chosen${missed.length > 0 ? '; ×: not converged' : ''}${Object.entries(unknown).map(([why, n]) => (n > 0 ? `; ${why}: ${n} of ${points.length} cells` : '')).join('')}`,
  };
}

function wordsOf(props: Props, cell: SweepCell): string {
  const [name, over] = namesOf(props);
  return `${over} = ${exact(cell.values[0])}: ${name} ${metricText(cell, props.metric)} ${outcomeOf(cell)}`;
}

export function Line(props: Props) {
  const {cells, metric, chosen, choose, open, source} = props;
  const points = useMemo(() => pointsOf(cells), [cells]);
  const panel = useMemo(() => linePanel(props, points), [points, metric, chosen]);
  const cell = points.find(({index}) => index === chosen);
  const pick = (place: number) => {
    const {index} = points[place]!;
    if (index === chosen) open(index); else choose(index);
  };
  const label = `${namesOf(props).join(' over ')}; arrow keys choose a cell, Enter runs it`;
  return (
    <>
      <Plot panel={panel} source={source} height={320} choosing={{label, press: keysOver(points, props), pick}} />
      <p class="pointed soft mono">{cell ? wordsOf(props, cell) : '\u00a0'}</p>
    </>
  );
}
