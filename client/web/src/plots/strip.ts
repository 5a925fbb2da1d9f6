// Draws the bodies on their line at one moment, with contact forces.

import {values} from '../model/curves';
import {interpolate} from '../model/panel';
import {short} from '../model/numbers';
import type {ContactModel} from '../model/mechanics';
import type {Stage} from '../model/stage';
import {readableUnit} from '../model/units';
import {colourOf, type Theme} from '../ui/theme';
import type {Ink} from './axes';

/** One canvas and what to draw with. */
export interface Sheet {
  ctx: CanvasRenderingContext2D;
  width: number;
  height: number;
  ink: Ink;
  theme: Theme;
}

export const STRIP_PX = 132;   // In height.
const SPRING_PX = 50;          // Of a spring to the ground at least, where there is room.

/** A canvas made ready to be drawn on, in the colours of the page. */
export function sheetOf(canvas: HTMLCanvasElement, width: number, theme: Theme): Sheet {
  const ratio = devicePixelRatio;
  Object.assign(canvas, {width: width * ratio, height: STRIP_PX * ratio});
  const ctx = canvas.getContext('2d')!;
  ctx.scale(ratio, ratio);
  const style = getComputedStyle(canvas);
  const ink = (name: string) => style.getPropertyValue(`--${name}`).trim();
  return {ctx, width, height: STRIP_PX, theme, ink: {text: ink('text'), soft: ink('soft'), grid: ink('grid'), band: ink('band'), paper: ink('paper'), warn: ink('warn')}};
}

/** Where the bodies are at a moment; where they begin if nothing is recorded yet. */
function placesAt({mechanics, series, magnification}: Stage, time: number): number[] {
  const times = values(series, 'time');
  return mechanics.bodies.map(({name, position}) =>
    position + magnification * (interpolate(times, values(series, `${name}.position`), time) - position || 0));
}

/** Where the face of a contact's wall is at a moment; NaN without a wall. */
function wallAt({series, magnification}: Stage, {wallPosition, wallBody, wallOrigin}: ContactModel, time: number): number {
  const moved = wallBody ? interpolate(values(series, 'time'), values(series, `${wallBody}.position`), time) - wallOrigin : 0;
  return wallPosition + magnification * (moved || 0);
}

function spring(ctx: CanvasRenderingContext2D, from: number, to: number, y: number): void {
  const turns = 9;
  ctx.beginPath();
  ctx.moveTo(from, y);
  for (let i = 1; i < turns; ++i) ctx.lineTo(from + (to - from) * i / turns, y + (i % 2 ? -5 : 5));
  ctx.lineTo(to, y);
  ctx.stroke();
}

function arrow(ctx: CanvasRenderingContext2D, from: number, to: number, y: number): void {
  const head = Math.sign(to - from) * Math.min(6, Math.abs(to - from));
  ctx.beginPath();
  ctx.moveTo(from, y);
  ctx.lineTo(to, y);
  ctx.moveTo(to - head, y - 4);
  ctx.lineTo(to, y);
  ctx.lineTo(to - head, y + 4);
  ctx.stroke();
}

function drawWall({ctx, ink}: Sheet, x: number, right: boolean, middle: number): void {
  ctx.strokeStyle = ink.soft;
  ctx.beginPath();
  ctx.moveTo(x, middle - 34);
  ctx.lineTo(x, middle + 34);
  for (let y = middle - 30; y <= middle + 34; y += 8) { ctx.moveTo(x, y - 4); ctx.lineTo(x + (right ? 6 : -6), y + 2); }
  ctx.stroke();
}

function drawSupports(stage: Stage, {ctx, ink}: Sheet, toX: (x: number) => number, places: number[], middle: number): void {
  const index = new Map(stage.mechanics.bodies.map(({name}, i) => [name, i]));
  ctx.strokeStyle = ink.soft;
  for (const {body, other} of stage.mechanics.scenario.supports) {
    const i = index.get(body)!;
    const end = toX(places[i]! - stage.mechanics.bodies[i]!.radius);
    spring(ctx, other ? toX(places[index.get(other)!]!) : Math.max(Math.min(toX(stage.low), end - SPRING_PX), 0), end, middle);
  }
}

const largestRadius = ({mechanics}: Stage) => Math.max(0, ...mechanics.bodies.map(({radius}) => radius));

function drawForces(stage: Stage, sheet: Sheet, toX: (x: number) => number, places: number[], time: number, middle: number): void {
  const scale = toX(1) - toX(0);
  const {mechanics: {bodies, contacts}, series, largestForce} = stage;
  const {ctx, theme} = sheet;
  const times = values(series, 'time');
  contacts.forEach((contact, colour) => {
    const {name, left, right} = contact;
    const wallPosition = wallAt(stage, contact, time);
    const force = interpolate(times, values(series, `${name}.contact_force`), time);
    if (!(Math.abs(force) > 1e-6 * largestForce)) return;
    const leftEdge = left < 0 ? wallPosition : places[left]! + bodies[left]!.radius;
    const rightEdge = right < 0 ? wallPosition : places[right]! - bodies[right]!.radius;
    const x = toX((leftEdge + rightEdge) / 2);
    const length = 8 + 40 * Math.abs(force) / largestForce;
    ctx.strokeStyle = ctx.fillStyle = colourOf(colour, theme);
    ctx.lineWidth = 2;
    if (left >= 0) arrow(ctx, x - 2, x - length, middle);
    if (right >= 0) arrow(ctx, x + 2, x + length, middle);
    ctx.lineWidth = 1;
    const {factor, label} = readableUnit('[N]', Math.abs(force));
    ctx.textAlign = x > sheet.width - 40 ? 'right' : x < 40 ? 'left' : 'center';
    ctx.fillText(`${short(force / factor, 3)} ${label.replace(/[[\]]/g, '')}`, x, middle - Math.min(largestRadius(stage) * scale, 40) - 6 - (colour % 2) * 12);
  });
}

/** An arrow above each body that moves, with its speed. */
function drawVelocities({mechanics: {bodies}, velocities = []}: Stage, {ctx, ink, width}: Sheet, toX: (x: number) => number, places: number[], middle: number): void {
  const scale = toX(1) - toX(0);
  const largest = Math.max(...velocities.map(Math.abs), 0);
  ctx.strokeStyle = ctx.fillStyle = ink.text;
  velocities.forEach((velocity, i) => {
    if (!(Math.abs(velocity) > 0)) return;
    const [x, y] = [toX(places[i]!), middle - Math.max(bodies[i]!.radius * scale, 4) - 7];
    arrow(ctx, x, x + Math.sign(velocity) * (12 + 28 * Math.abs(velocity) / largest), y);
    ctx.textAlign = x > width - 60 ? 'right' : x < 60 ? 'left' : 'center';
    ctx.fillText(`${short(Math.abs(velocity), 3)} m/s`, x, y - 5);
  });
}

/** How metres become px on a strip of this width. */
export function scaleOf(stage: Stage, width: number): {scale: number; toX: (x: number) => number} {
  const {low, high} = stage;
  const scale = Math.min(width / (high - low), (STRIP_PX / 2 - 24) / (largestRadius(stage) || 1e-300));
  return {scale, toX: (x) => width / 2 + (x - (low + high) / 2) * scale};
}

/** Draws the moment. */
export function drawStrip(stage: Stage, sheet: Sheet, time: number): void {
  const {ctx, width, height, ink, theme} = sheet;
  const {mechanics: {bodies, contacts}} = stage;
  const {scale, toX} = scaleOf(stage, width);
  const middle = height / 2 + 4;
  const places = placesAt(stage, time);
  ctx.clearRect(0, 0, width, height);
  ctx.font = '11px system-ui, sans-serif';
  ctx.strokeStyle = ink.grid;
  ctx.beginPath();
  ctx.moveTo(0, middle);
  ctx.lineTo(width, middle);
  ctx.stroke();
  for (const contact of contacts) {
    const face = wallAt(stage, contact, time);
    if (Number.isFinite(face)) drawWall(sheet, toX(face), contact.left >= 0, middle);
  }
  drawSupports(stage, sheet, toX, places, middle);
  bodies.forEach(({name, radius, fixed}, i) => {
    const r = Math.max(radius * scale, 4);
    ctx.beginPath();
    ctx.arc(toX(places[i]!), middle, r, 0, 2 * Math.PI);
    ctx.fillStyle = `${colourOf(i, theme)}${fixed ? '22' : '44'}`;
    ctx.strokeStyle = colourOf(i, theme);
    ctx.fill();
    ctx.stroke();
    ctx.fillStyle = ink.text;
    ctx.textAlign = 'center';
    if (bodies.length <= 24) ctx.fillText(name, toX(places[i]!), r > 30 ? middle + r / 2 + 4 : middle + r + 13);
  });
  drawForces(stage, sheet, toX, places, time, middle);
  drawVelocities(stage, sheet, toX, places, middle);
}
