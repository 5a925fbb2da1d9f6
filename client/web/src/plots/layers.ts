// What uPlot does not draw: bands, lanes of groups, marks, loops, labels. Positions are pixels of
// the canvas.

import type uPlot from 'uplot';

import {rarePoints, spreadOf} from '../model/coarse';
import {isHidden, type Curve, type Panel} from '../model/panel';
import {pixelsOf, waterfallOf, type Raster} from '../model/raster';
import {colourOf, dashOf, type Theme} from '../ui/theme';
import {FONT, type Ink} from './axes';
import {crowded, endNames, placeLabels, shortName} from './words';

export const LANE_PX = 10;
const MARK_PX = 4.5;
const DOT_PX = 2.2;
const RARE_PX = 1.2;
export const HATCH_PX = 7;

interface Sheet {
  u: uPlot;
  panel: Panel;
  theme: Theme;
  ink: Ink;
}

const px = (u: uPlot, x: number) => u.valToPos(x, 'x', true);
const py = (u: uPlot, y: number) => u.valToPos(y, 'y', true);

function clipped({u}: Sheet, draw: (ctx: CanvasRenderingContext2D) => void): void {
  const {left, top, width, height} = u.bbox;
  u.ctx.save();
  u.ctx.beginPath();
  u.ctx.rect(left, top, width, height);
  u.ctx.clip();
  draw(u.ctx);
  u.ctx.restore();
}

/** The colours of what a raster shows between two moments, a pixel for each row. */
export function pictureOf(raster: Raster, window: [number, number], columns: number): HTMLCanvasElement {
  const canvas = Object.assign(document.createElement('canvas'), {width: columns, height: raster.rows.length});
  canvas.getContext('2d')!.putImageData(new ImageData(pixelsOf(raster, window, columns), columns), 0, 0);
  return canvas;
}

function drawWaterfall(sheet: Sheet, raster: Raster): void {
  const {u, theme} = sheet;
  clipped(sheet, (ctx) => {
    ctx.lineWidth = devicePixelRatio;
    ctx.lineJoin = 'round';
    for (const {colour, y} of waterfallOf(raster, theme === 'dark')) {
      ctx.beginPath();
      for (let i = 0; i < y.length; ++i) ctx.lineTo(px(u, raster.time[i]!), py(u, y[i]!));
      ctx.strokeStyle = colour;
      ctx.stroke();
    }
  });
}

function drawRaster(sheet: Sheet): void {
  const {u, panel: {raster}} = sheet;
  if (!raster || raster.time.length === 0) return;
  if (raster.lines) return drawWaterfall(sheet, raster);
  const {left, top, width, height} = u.bbox;
  const {min, max} = u.scales.x!;
  u.ctx.imageSmoothingEnabled = false;
  u.ctx.drawImage(pictureOf(raster, [min!, max!], Math.round(width)), left, top, width, height);
}

/** Oblique lines where the end of the run cuts a cycle. */
function drawCut({u, panel, ink}: Sheet, ctx: CanvasRenderingContext2D): void {
  const {top, height} = u.bbox;
  const step = HATCH_PX * devicePixelRatio;
  ctx.strokeStyle = ink.grid;
  ctx.lineWidth = devicePixelRatio;
  for (const {start, end} of panel.cut ?? []) {
    const [from, to] = [px(u, start), px(u, end)];
    ctx.save();
    ctx.beginPath();
    ctx.rect(from, top, to - from, height);
    ctx.clip();
    ctx.beginPath();
    for (let x = Math.max(from, u.bbox.left) - height; x < Math.min(to, u.bbox.left + u.bbox.width); x += step) {
      ctx.moveTo(x, top + height);
      ctx.lineTo(x + height, top);
    }
    ctx.stroke();
    ctx.restore();
  }
}

/** Boxes from the smallest to the largest value of contacts, or of samples; an edge, for most are narrower than a pixel. */
function drawRanges({u, panel, theme}: Sheet, hidden: Set<string>, ctx: CanvasRenderingContext2D): void {
  ctx.globalAlpha = 0.3;
  ctx.lineWidth = devicePixelRatio / 2;
  for (const {label, colour, start, end, low, high} of [...panel.ranges ?? [], ...spreadOf(panel)]) {
    if (hidden.has(label)) continue;
    ctx.fillStyle = ctx.strokeStyle = colourOf(colour, theme);
    const box = [px(u, start), py(u, high), px(u, end) - px(u, start), py(u, low) - py(u, high)] as const;
    ctx.fillRect(...box);
    ctx.strokeRect(...box);
  }
  ctx.globalAlpha = 1;
}

/** Shades behind the curves, and a bar for each group above them. */
export function drawBehind(sheet: Sheet, hidden: Set<string>): void {
  const {u, panel, ink, theme} = sheet;
  const {top, height, left, width} = u.bbox;
  drawRaster(sheet);
  clipped(sheet, (ctx) => {
    ctx.fillStyle = ink.band;
    for (const {start, end} of panel.bands ?? []) {
      ctx.fillRect(px(u, start), top, Math.max(px(u, end) - px(u, start), 1), height);
    }
    drawCut(sheet, ctx);
    drawRanges(sheet, hidden, ctx);
  });
  const ratio = devicePixelRatio;
  (panel.lanes ?? []).forEach(({bars, colour}, i) => {
    const y = top - (panel.lanes!.length - i) * LANE_PX * ratio;
    for (const {start, end, text} of bars) {
      const from = Math.max(px(u, start), left);
      const to = Math.min(px(u, end), left + width);
      if (to <= from) continue;
      u.ctx.fillStyle = colourOf(colour, theme);
      u.ctx.fillRect(from, y, Math.max(to - from - ratio, 1), (LANE_PX - 2) * ratio);
      if (to - from < (8 + 6 * text.length) * ratio) continue;
      u.ctx.fillStyle = ink.paper;
      u.ctx.font = `600 ${8 * ratio}px system-ui, sans-serif`;
      u.ctx.textAlign = 'center';
      u.ctx.textBaseline = 'middle';
      u.ctx.fillText(text, (from + to) / 2, y + (LANE_PX - 2) * ratio / 2 + 0.5 * ratio);
    }
  });
}

function drawMarks({u, theme}: Sheet, curve: Curve): void {
  if (crowded(u, curve)) return;
  const {ctx} = u;
  const r = MARK_PX * devicePixelRatio;
  ctx.beginPath();
  for (let i = 0; i < curve.x.length; ++i) {
    const x = px(u, curve.x[i]!);
    const y = py(u, curve.y[i]!);
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    if (curve.mark === 'start') { ctx.moveTo(x + r, y); ctx.arc(x, y, r, 0, 2 * Math.PI); }
    else { ctx.moveTo(x - r, y - r); ctx.lineTo(x + r, y + r); ctx.moveTo(x - r, y + r); ctx.lineTo(x + r, y - r); }
  }
  ctx.strokeStyle = colourOf(curve.colour, theme);
  ctx.lineWidth = 1.4 * devicePixelRatio;
  ctx.stroke();
}

/** Dots with a rim, so that they are seen on their curve. */
function drawDots({u, theme, ink}: Sheet, {x, y, colour}: Curve): void {
  const {ctx} = u;
  const r = DOT_PX * devicePixelRatio;
  ctx.beginPath();
  for (let i = 0; i < x.length; ++i) {
    const [a, b] = [px(u, x[i]!), py(u, y[i]!)];
    ctx.moveTo(a + r, b);
    ctx.arc(a, b, r, 0, 2 * Math.PI);
  }
  ctx.fillStyle = colourOf(colour, theme);
  ctx.strokeStyle = ink.paper;
  ctx.lineWidth = 1.5 * devicePixelRatio;
  ctx.stroke();
  ctx.fill();
}

/** Tiny dots: samples that no line joins. */
function drawRare({u, theme}: Sheet, colour: number, points: Iterable<[number, number]>): void {
  const r = RARE_PX * devicePixelRatio;
  u.ctx.fillStyle = colourOf(colour, theme);
  for (const [x, y] of points) u.ctx.fillRect(px(u, x) - r, py(u, y) - r, 2 * r, 2 * r);
}

function drawLoop({u, theme}: Sheet, curve: Curve): void {
  const {ctx} = u;
  ctx.beginPath();
  for (let i = 0; i < curve.x.length; ++i) ctx.lineTo(px(u, curve.x[i]!), py(u, curve.y[i]!));
  ctx.strokeStyle = colourOf(curve.colour, theme);
  ctx.lineWidth = 1.6 * devicePixelRatio;
  ctx.setLineDash(dashOf(curve.colour).map((d) => d * devicePixelRatio));
  ctx.stroke();
  ctx.setLineDash([]);
}

function drawNames({u, panel, theme}: Sheet, hidden: Set<string>): void {
  const {ctx, bbox} = u;
  const ratio = devicePixelRatio;
  const shown = panel.curves.filter(({label}) => !hidden.has(label));
  ctx.font = `${11 * ratio}px system-ui, sans-serif`;
  ctx.textAlign = 'left';
  ctx.textBaseline = 'middle';
  for (const {curve, y} of endNames(u, shown, bbox.top + bbox.height, 13 * ratio, (v) => py(u, v))) {
    ctx.fillStyle = colourOf(curve.colour, theme);
    ctx.fillText(shortName(curve.label), bbox.left + bbox.width + 5 * ratio, y);
  }
}

function drawLabels({u, panel, ink}: Sheet): void {
  const {ctx} = u;
  ctx.font = FONT.replace('12px', `${11 * devicePixelRatio}px`);
  ctx.fillStyle = ink.soft;
  ctx.textBaseline = 'bottom';
  const {left, width} = u.bbox;
  const size = (text: string) => ctx.measureText(text).width;
  ctx.textAlign = 'left';
  for (const {text, x, y} of placeLabels(u, panel, (v) => px(u, v), (v) => py(u, v), size, 13 * devicePixelRatio)) {
    ctx.fillText(text, Math.min(Math.max(x, left), left + width - size(text)), y - 5 * devicePixelRatio);
  }
}

/** In the plot, so that it goes wherever its picture goes. */
function drawStamp({u, panel: {stamp}, ink}: Sheet): void {
  if (!stamp) return;
  const {ctx, bbox: {left, top, width}} = u;
  const ratio = devicePixelRatio;
  ctx.font = FONT.replace('12px', `${10 * ratio}px`);
  ctx.textAlign = 'right';
  ctx.textBaseline = 'top';
  const wide = ctx.measureText(stamp).width;
  ctx.globalAlpha = 0.8;
  ctx.fillStyle = ink.paper;
  ctx.fillRect(left + width - wide - 8 * ratio, top + 2 * ratio, wide + 6 * ratio, 14 * ratio);
  ctx.globalAlpha = 1;
  ctx.fillStyle = ink.warn;
  ctx.fillText(stamp, left + width - 5 * ratio, top + 4 * ratio);
}

/** Loops, marks and labels over the curves. */
export function drawOver(sheet: Sheet, hidden: Set<string>, named: boolean): void {
  const {u, panel, ink} = sheet;
  clipped(sheet, (ctx) => {
    ctx.strokeStyle = ink.soft;
    ctx.setLineDash([2, 4]);
    for (const y of panel.dottedLines ?? []) {
      ctx.beginPath();
      ctx.moveTo(u.bbox.left, py(u, y));
      ctx.lineTo(u.bbox.left + u.bbox.width, py(u, y));
      ctx.stroke();
    }
    ctx.setLineDash([]);
    for (const curve of panel.curves) {
      if (isHidden(curve, hidden)) continue;
      if (curve.mark === 'start' || curve.mark === 'end') drawMarks(sheet, curve);
      else if (curve.mark === 'points') drawDots(sheet, curve);
      else if (curve.mark === 'rare') drawRare(sheet, curve.colour, Array.from(curve.x, (x, i) => [x, curve.y[i]!]));
      else if (!panel.overTime) drawLoop(sheet, curve);
      else drawRare(sheet, curve.colour, rarePoints(curve));
    }
    drawLabels(sheet);
    drawStamp(sheet);
  });
  if (named && panel.overTime) drawNames(sheet, hidden);
}
