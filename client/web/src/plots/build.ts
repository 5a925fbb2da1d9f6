// Makes a uPlot of a panel.

import uPlot from 'uplot';

import {travel, type Curve, type Panel} from '../model/panel';
import {colourOf, dashOf, type Theme} from '../ui/theme';
import {axesOf, type Ink} from './axes';
import {drawBehind, drawOver, LANE_PX} from './layers';
import {shortName} from './words';
import {xRange, yRange, type Window} from './range';

/** What a plot shows now; uPlot's functions read it when they draw. */
export interface Shown {
  panel: Panel;
  window: Window | undefined;
  hidden: Set<string>;
  theme: Theme;
  ink: Ink;
  onZoom: (window: Window | undefined) => void;
  onCursor: (index: number | null) => void;
  onDrawn: () => void;
}

export const NAMED_FROM_PX = 480;   // Narrower plots have no room for names beside the curves.
const STEEP = 8;             // Pixels up and down for each pixel along, from which on a curve fills an area.
const SOLID: number[] = [];

/** The curves that uPlot draws. */
export function lines(panel: Panel): Curve[] {
  return panel.overTime ? panel.curves.filter(({mark}) => mark !== 'start' && mark !== 'end' && mark !== 'points' && mark !== 'rare') : [];
}

/** The curves that are dots over others. */
export const dotted = (panel: Panel) => panel.curves.filter(({mark}) => mark === 'points');

/** Columns on one x axis, as uPlot takes them. */
export function aligned(panel: Panel): uPlot.AlignedData {
  const curves = lines(panel);
  if (curves.length === 0) return [panel.raster && panel.raster.time.length > 0 ? panel.raster.time as number[] : [0, 1], []];
  const first = curves[0]!.x;
  if (curves.every(({x}) => x === first)) {
    return [first, ...curves.map(({y}) => y)] as unknown as uPlot.AlignedData;
  }
  const xs = [...new Set(curves.flatMap(({x}) => Array.from(x)))].sort((a, b) => a - b);
  const place = new Map(xs.map((x, i) => [x, i]));
  return [xs, ...curves.map(({x, y}) => {
    const column: (number | null)[] = new Array<number | null>(xs.length).fill(null);
    for (let i = 0; i < x.length; ++i) column[place.get(x[i]!)!] = y[i]!;
    return column;
  })];
}

/** Draws a curve thin and solid where it fills an area: nobody sees its dashes, and each takes time. */
function pathsOf(style: {width: number; dash: number[]}): uPlot.Series.PathBuilder {
  const build = uPlot.paths.linear!();
  return (u, place, first, last) => {
    const {min, max} = u.scales.y!;
    const up = travel(u.data[place]!, first, last) / (max! - min!) * u.bbox.height;
    Object.assign(u.series[place]!, up > STEEP * u.bbox.width ? {width: 1, dash: SOLID} : style);
    return build(u, place, first, last);
  };
}

/** Where a curve is not drawn, in pixels: where samples are too rare. Over values that are not there it goes on. */
function gapsOf(shown: Shown): uPlot.Series.GapsRefiner {
  return (u, place) => (lines(shown.panel)[place - 1]?.loose ?? []).map(({start, end}): [number, number] =>
    [u.valToPos(start, 'x', true), u.valToPos(end, 'x', true)]);
}

function seriesOf(shown: Shown): uPlot.Series[] {
  const {panel, theme, hidden, ink} = shown;
  const drawn = lines(panel).map((curve): uPlot.Series => ({
    label: curve.label,
    show: !hidden.has(curve.label),
    stroke: colourOf(curve.colour, theme),
    paths: pathsOf(curve.mark === 'dashed' ? {width: 1.2, dash: [6, 4]} : {width: 1.6, dash: dashOf(curve.colour)}),
    points: {show: curve.mark === 'linePoints', size: 6, fill: ink.paper},
    spanGaps: false,
    gaps: gapsOf(shown),
  }));
  return [{label: 'x'}, ...(drawn.length > 0 ? drawn : [{show: false}])];
}

function rightPadding(panel: Panel, width: number): number {
  if (!panel.overTime || width < NAMED_FROM_PX) return 12;
  const longest = Math.max(0, ...lines(panel).filter(({mark}) => mark !== 'dashed').map(({label}) => shortName(label).length));
  return 14 + 6.5 * longest;
}

/** The cursor reads the curves by rings, through which they are seen. */
function cursorOf(shown: Shown): uPlot.Cursor {
  const colour = (_u: uPlot, place: number) => colourOf(lines(shown.panel)[place - 1]?.colour ?? 0, shown.theme);
  const timed = shown.panel.overTime && !shown.panel.countedX;
  return {
    show: shown.panel.overTime, y: false,
    drag: {x: timed, y: false, setScale: false, dist: 5},
    points: {size: 9, width: 1.5, fill: 'transparent', stroke: colour},
    ...(timed ? {sync: {key: 'time', setSeries: false}} : {}),
    bind: {dblclick: () => () => { shown.onZoom(undefined); return null; }},
  };
}

function takeSelection(u: uPlot, shown: Shown): void {
  const {left, width} = u.select;
  if (width < 5) return;
  shown.onZoom([u.posToVal(left, 'x'), u.posToVal(left + width, 'x')]);
  u.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
}

/** Makes the plot; `shown` may be changed afterwards, followed by `setData`. */
export function buildPlot(shown: Shown, width: number, height: number, into: HTMLElement): uPlot {
  const {panel, ink} = shown;
  const sheet = (u: uPlot) => ({u, panel: shown.panel, theme: shown.theme, ink: shown.ink});
  const top = 8 + LANE_PX * (panel.lanes?.length ?? 0);
  return new uPlot({
    width, height,
    padding: [top, (u) => rightPadding(shown.panel, u.width ?? width), 0, 0],
    legend: {show: false},
    scales: {
      x: {time: false, distr: panel.logX ? 3 : 1, range: () => xRange(shown.panel, shown.window)},
      y: {distr: panel.logY ? 3 : 1, range: () => yRange(shown.panel, xRange(shown.panel, shown.window))},
    },
    axes: axesOf(() => shown.panel, ink),
    series: seriesOf(shown),
    cursor: cursorOf(shown),
    hooks: {
      drawAxes: [(plot) => drawBehind(sheet(plot), shown.hidden)],
      draw: [(plot) => drawOver(sheet(plot), shown.hidden, plot.width >= NAMED_FROM_PX), () => shown.onDrawn()],
      setSelect: [(plot) => takeSelection(plot, shown)],
      setCursor: [(plot) => shown.onCursor(plot.cursor.idx ?? null)],
    },
  }, aligned(panel), into);
}
