// A plot as SVG: the axes that uPlot chose, the curves of the panel.

import type uPlot from 'uplot';

import look from '../../../python/contactsim/figures/words.json';
import {isLoose, rarePoints, spreadOf} from '../model/coarse';
import type {Curve, Panel} from '../model/panel';
import {waterfallOf, type Raster} from '../model/raster';
import {colourOf, dashOf} from '../ui/theme';
import {unitOfScale} from './axes';
import {dotted, lines, NAMED_FROM_PX} from './build';
import {HATCH_PX, LANE_PX, pictureOf} from './layers';
import {crowded, endNames, placeLabels, shortName} from './words';

export interface Svg {
  width: number;
  height: number;
  text: string;
}

const TITLE_PX = 26;
const FOOT_PX = 9;       // Below the last line.
const LINE_PX = 14;      // Of the foot.
const LETTER_PX = 5.4;   // On average, at 10 px.
const SWATCH_PX = 26;
const escape = (text: string) =>
  text.replace(/[&<>"]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'})[c]!);
const r = (value: number) => String(Math.round(value * 100) / 100);

/** Positions in the drawing. */
interface Frame {
  u: uPlot;
  left: number;
  top: number;
  width: number;
  height: number;
  x: (value: number) => number;
  y: (value: number) => number;
}

function frameOf(u: uPlot): Frame {
  const ratio = devicePixelRatio;
  const left = u.bbox.left / ratio;
  const top = u.bbox.top / ratio + TITLE_PX;
  return {
    u, left, top, width: u.bbox.width / ratio, height: u.bbox.height / ratio,
    x: (value) => left + u.valToPos(value, 'x'), y: (value) => top + u.valToPos(value, 'y'),
  };
}

type DrawnAxis = uPlot.Axis & {_splits?: number[]; _values?: string[]};

function axis(frame: Frame, place: 0 | 1, label: string): string {
  const {_splits: splits = [], _values: texts = []} = frame.u.axes[place] as DrawnAxis;
  const {left, top, width, height} = frame;
  const bottom = top + height;
  const parts = splits.flatMap((value, i) => {
    const at = place === 0 ? frame.x(value) : frame.y(value);
    const line = place === 0 ? `M${r(at)} ${r(top)}V${r(bottom + 5)}` : `M${r(left - 5)} ${r(at)}H${r(left + width)}`;
    const text = place === 0 ? `x="${r(at)}" y="${r(bottom + 18)}" text-anchor="middle"` : `x="${r(left - 8)}" y="${r(at + 4)}" text-anchor="end"`;
    return [`<path class="tick" d="${line}" stroke="#ddd"/>`, texts[i] ? `<text class="tick" ${text}>${escape(String(texts[i]))}</text>` : ''];
  });
  const name = place === 0
    ? `<text x="${r(left + width / 2)}" y="${r(bottom + 36)}" text-anchor="middle" font-weight="600">`
    : `<text transform="translate(13 ${r(top + height / 2)}) rotate(-90)" text-anchor="middle" font-weight="600">`;
  return `${parts.join('')}${name}${escape(unitOfScale(frame.u, place === 0 ? 'x' : 'y', label).label)}</text>`;
}

function strokeOf({mark, colour}: Curve): string {
  const dash = mark === 'dashed' ? [6, 4] : mark === 'line' ? dashOf(colour) : [];
  return `stroke="${colourOf(colour, 'light')}" stroke-width="1.5"${dash.length ? ` stroke-dasharray="${dash.join(' ')}"` : ''}`;
}

const circle = (size: number) => `M${size} 0a${size} ${size} 0 1 0 ${-2 * size} 0a${size} ${size} 0 1 0 ${2 * size} 0`;
const MARKS = `<path id="start" d="${circle(4)}"/><path id="end" d="M-4 -4l8 8m0 -8l-8 8"/><path id="linePoints" d="${circle(3)}"/><path id="points" d="${circle(2)}"/>`;

/** A mark at each point. */
function marksOf({mark, x: xs, y: ys}: Curve, x: Frame['x'], y: Frame['y']): string {
  return Array.from(xs, (value, i) => [x(value), y(ys[i]!)]).filter((at) => at.every(Number.isFinite))
    .map(([a, b]) => `<use href="#${mark}" x="${r(a!)}" y="${r(b!)}"/>`).join('');
}

const dots = (curve: Curve, x: Frame['x'], y: Frame['y']): string =>
  `<g fill="${colourOf(curve.colour, 'light')}" stroke="#fff" stroke-width="0.7">${marksOf(curve, x, y)}</g>`;

/** Tiny dots: samples that no line joins. */
function rare(points: [number, number][], colour: number, {x, y}: Frame): string {
  const path = points.map(([at, value]) => `M${r(x(at) - 1)} ${r(y(value))}h2`).join('');
  return path && `<path d="${path}" stroke="${colourOf(colour, 'light')}" stroke-width="2"/>`;
}

function curve(frame: Frame, drawn: Curve): string {
  const {u, x, y} = frame;
  const {mark, x: xs, y: ys, loose = []} = drawn;
  if ((mark === 'start' || mark === 'end') && crowded(u, drawn)) return '';
  if (mark === 'points') return dots(drawn, x, y);
  if (mark === 'start' || mark === 'end') return `<g ${strokeOf(drawn)}>${marksOf(drawn, x, y)}</g>`;
  if (mark === 'rare') return rare(Array.from(xs, (at, i) => [at, ys[i]!]), drawn.colour, frame);
  let path = '';
  let pen = 'M';
  for (let i = 0; i < xs.length; ++i) {
    const [a, b] = [x(xs[i]!), y(ys[i]!)];
    if (ys[i] === null) pen = 'M';   // A logarithm of what is not above 0.
    if (!Number.isFinite(a) || !Number.isFinite(b)) continue;
    if (isLoose(loose, xs[i]!)) pen = 'M';
    else { path += `${pen}${r(a)} ${r(b)}`; pen = 'L'; }
  }
  return `<path d="${path}" ${strokeOf(drawn)}/>${mark === 'linePoints' ? `<g ${strokeOf(drawn)}>${marksOf(drawn, x, y)}</g>` : ''}${rare(rarePoints(drawn), drawn.colour, frame)}`;
}

function waterfall({x, y: at}: Frame, raster: Raster): string {
  return waterfallOf(raster).map(({colour, y}) =>
    `<path d="${Array.from(y, (value, i) => `${i ? 'L' : 'M'}${r(x(raster.time[i]!))} ${r(at(value))}`).join('')}" stroke="${colour}"/>`).join('');
}

/** What the end of the run cuts, and between which values contacts and swings are that have too few samples. */
function coarse({x, y, top, height}: Frame, panel: Panel): string {
  const {cut = [], ranges = []} = panel;
  const box = (from: number, to: number, low: number, high: number) => `x="${r(from)}" y="${r(low)}" width="${r(to - from)}" height="${r(high - low)}"`;
  return [
    ...cut.map(({start, end}) => `<rect ${box(x(start), x(end), top, top + height)} fill="url(#cut)"/>`),
    ...[...ranges, ...spreadOf(panel)].map(({colour, start, end, low, high}) =>
      `<rect ${box(x(start), x(end), y(high), y(low))} fill="${colourOf(colour, 'light')}" stroke="${colourOf(colour, 'light')}" stroke-width="0.5" opacity="0.3"/>`),
  ].join('');
}

const HATCH = `<pattern id="cut" width="${HATCH_PX}" height="${HATCH_PX}" patternUnits="userSpaceOnUse" patternTransform="rotate(45)"><path d="M0 0V${HATCH_PX}" stroke="${look.faint}"/></pattern>`;

/** What the samples are too few for. */
function stampOn({left, top, width}: Frame, {stamp}: Panel): string {
  return stamp ? `<text x="${r(left + width - 5)}" y="${r(top + 12)}" text-anchor="end" font-size="10" fill="${look.map.failed}">${escape(stamp)}</text>` : '';
}

function behind(frame: Frame, panel: Panel): string {
  const {bands = [], dottedLines = [], raster} = panel;
  const {left, top, width, height} = frame;
  const {min, max} = frame.u.scales.x!;
  const image = (colours: Raster) => `<image x="${r(left)}" y="${r(top)}" width="${r(width)}" height="${r(height)}" preserveAspectRatio="none" style="image-rendering:pixelated" href="${pictureOf(colours, [min!, max!], Math.round(2 * width)).toDataURL()}"/>`;
  return [
    raster && raster.time.length > 0 ? (raster.lines ? waterfall(frame, raster) : image(raster)) : '',
    ...bands.map(({start, end}) => `<rect x="${r(frame.x(start))}" y="${r(top)}" width="${r(Math.max(frame.x(end) - frame.x(start), 0.5))}" height="${r(height)}" fill="#000" fill-opacity=".06" stroke="none"/>`),
    ...dottedLines.map((y) => `<path d="M${r(left)} ${r(frame.y(y))}h${r(width)}" stroke="#666" stroke-dasharray="2 4"/>`),
    coarse(frame, panel),
  ].join('');
}

/** The bars of groups above the curves. */
function bars({x, left, top, width}: Frame, {lanes = []}: Panel): string {
  return lanes.flatMap(({bars: all, colour}, i) => all.map(({start, end}) => {
    const [from, to] = [Math.max(x(start), left), Math.min(x(end), left + width)];
    return to > from ? `<rect class="label" x="${r(from)}" y="${r(top - (lanes.length - i) * LANE_PX)}" width="${r(Math.max(to - from - 1, 1))}" height="${LANE_PX - 2}" fill="${colourOf(colour, 'light')}"/>` : '';
  })).join('');
}

function names(frame: Frame, panel: Panel): string {
  const {curves, overTime} = panel;
  const {left, top, width, height} = frame;
  const placed = placeLabels(frame.u, panel, frame.x, frame.y, (text) => 6 * text.length, 13);
  const named = overTime && frame.u.width < NAMED_FROM_PX ? [] : overTime ? endNames(frame.u, curves, top + height, 13, frame.y)
    : curves.filter((c) => c.keyed !== false && (c.mark === 'line' || c.mark === 'rare')).map((c, i) => ({curve: c, y: top + 14 + 15 * i}));
  return [
    ...named.map(({curve: c, y}) => `<text x="${r(left + (overTime ? width + 5 : 10))}" y="${r(y + 4)}" fill="${colourOf(c.colour, 'light')}">${escape(overTime ? shortName(c.label) : c.label)}</text>`),
    ...placed.map(({x, y, text}) => `<text x="${r(Math.max(x, left))}" y="${r(y - 5)}" fill="#555" class="label">${escape(text)}</text>`),
  ].join('');
}

/** Lines of words that fit into a width. */
export function wrapped(words: string[], letters: number): string[] {
  const lines: string[] = [];
  for (const word of words) {
    const longer = `${lines.at(-1) ?? ''} ${word}`;
    if (lines.length > 0 && longer.length <= letters) lines[lines.length - 1] = longer;
    else lines.push(word);
  }
  return lines;
}

const same = (value: number) => value;

/** Swatches and names of the curves that have no name beside them, from left to right, as many in a line as fit. */
function keyOf(panel: Panel, named: boolean, left: number, room: number): {lines: number; draw: (top: number) => string} {
  let [x, line] = [0, 0];
  const listed = [...lines(panel).filter(({mark, label}) => !named || mark === 'dashed' || shortName(label) !== label), ...dotted(panel)];
  const places = listed.map((drawn) => {
    const width = SWATCH_PX + LETTER_PX * drawn.label.length + 14;
    if (x > 0 && x + width > room) [x, line] = [0, line + 1];
    x += width;
    return {drawn, x: left + x - width, line};
  });
  const draw = (top: number) => places.map(({drawn, x: at, line: row}) => {
    const y = top + LINE_PX * row;
    return `${drawn.mark === 'points' ? dots({...drawn, x: [at + SWATCH_PX - 8], y: [y - 3]}, same, same) : `<path d="M${r(at)} ${r(y - 3)}h${SWATCH_PX - 4}" ${strokeOf(drawn)}/>`}<text x="${r(at + SWATCH_PX)}" y="${r(y)}" font-size="10" fill="#333">${escape(drawn.label)}</text>`;
  }).join('');
  return {lines: places.length > 0 ? line + 1 : 0, draw};
}

/** What living.js reads of the axes. */
function axesOf({u, left, top, width, height}: Frame, panel: Panel): string {
  const scale = (name: 'x' | 'y', label: string, log: boolean | undefined) => {
    const {factor, label: shown} = unitOfScale(u, name, label);
    const {min, max} = u.scales[name]!;
    return {ends: [min! / factor, max! / factor, log ? 1 : 0], shown};
  };
  const [x, y] = [scale('x', panel.xLabel, panel.logX), scale('y', panel.yLabel, panel.logY)];
  return escape(JSON.stringify([{box: [left, top, width, height], x: x.ends, y: y.ends, names: [x.shown, y.shown], size: 12}]));
}

/** The plot as it is shown now. `source` stands below it. */
export function svgOf(panel: Panel, u: uPlot, source: string): Svg {
  const frame = frameOf(u);
  const width = u.width;
  const room = width - frame.left - 8;
  const notes = [source, panel.note].filter(Boolean).flatMap((text) => wrapped(text!.split(' '), room / LETTER_PX));
  const key = keyOf(panel, u.width >= NAMED_FROM_PX, frame.left, room);
  const foot = u.height + TITLE_PX + LINE_PX;
  const height = foot + LINE_PX * (key.lines + notes.length - 1) + FOOT_PX;
  const clip = `<clipPath id="in"><rect x="${r(frame.left)}" y="${r(frame.top)}" width="${r(frame.width)}" height="${r(frame.height)}"/></clipPath>`;
  const text = `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="12" data-axes="${axesOf(frame, panel)}">
<desc>${escape(source)}</desc><rect width="100%" height="100%" fill="#fff"/><defs>${clip}${HATCH}${MARKS}</defs>
<text x="${r(frame.left)}" y="18" font-size="14" font-weight="600">${escape(panel.title)}</text>
<g>${bars(frame, panel)}${axis(frame, 0, panel.xLabel)}${axis(frame, 1, panel.yLabel)}</g>
<g fill="none" clip-path="url(#in)" stroke-linejoin="round">${behind(frame, panel)}${panel.curves.map((c) => `<g data-name="${escape(c.label)}">${curve(frame, c)}</g>`).join('')}</g>
<g>${names(frame, panel)}${stampOn(frame, panel)}</g>
<g fill="none">${key.draw(foot)}</g>
${notes.map((text, i) => `<text x="${r(frame.left)}" y="${r(foot + LINE_PX * (key.lines + i))}" font-size="10" fill="#666">${escape(text)}</text>`).join('')}</svg>`;
  return {width, height, text};
}
