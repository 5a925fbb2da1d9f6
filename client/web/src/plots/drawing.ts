// An SVG of the page: where the pointer is in it, and the same drawing as a file.

import type {Svg} from './svg';

const TITLE_PX = 26;
const FOOT_PX = 20;
const INKS = ['text', 'soft', 'panel', 'rule', 'accent'];
// The rules of style.css for drawings; a file has no other.
const RULES = '.ink{fill:var(--text)}.name{font-weight:600}.halo{paint-order:stroke;stroke-width:5;stroke-linejoin:round;font-weight:700}'
  + '.edge{paint-order:stroke;stroke:var(--panel);stroke-width:4;stroke-linejoin:round}.bright{stroke:#fff}.dark{stroke:#000}.cell{stroke:var(--panel)}.chosen{fill:none;stroke:#fff;stroke-width:2}.rim{stroke:#000;stroke-width:5}.rule{stroke:var(--soft)}.grip,.end{fill:none}.range{fill:var(--accent);fill-opacity:.2}';

/** The point of an event in the units of the drawing. */
export function pointIn(drawn: SVGSVGElement, {clientX, clientY}: MouseEvent): [number, number] {
  const {x, y} = new DOMPoint(clientX, clientY).matrixTransform(drawn.getScreenCTM()!.inverse());
  return [x, y];
}

function text(y: number, size: number, ink: string, words: string): Element {
  const made = document.createElementNS('http://www.w3.org/2000/svg', 'text');
  Object.entries({x: '10', y: String(y), 'font-size': String(size), fill: `var(--${ink})`}).forEach(([k, v]) => made.setAttribute(k, v));
  made.textContent = words;
  return made;
}

/** The drawing as a file, in the colours of the page, with a title above and its source below. */
export function drawingOf(drawn: SVGSVGElement, title: string, source: string): Svg {
  const {width, height} = drawn.viewBox.baseVal;
  const whole = height + TITLE_PX + FOOT_PX;
  const inks = getComputedStyle(drawn);
  const copy = drawn.cloneNode(true) as SVGSVGElement;
  const style = document.createElementNS('http://www.w3.org/2000/svg', 'style');
  style.textContent = `svg{${INKS.map((name) => `--${name}:${inks.getPropertyValue(`--${name}`).trim()}`).join(';')};background:var(--panel)}${RULES}`;
  copy.prepend(style, text(-8, 14, 'text', title));
  copy.append(text(height + 14, 10, 'soft', source));
  Object.entries({width: String(width), height: String(whole), viewBox: `0 ${-TITLE_PX} ${width} ${whole}`,
    'font-family': 'system-ui, sans-serif', 'font-size': '12'}).forEach(([k, v]) => copy.setAttribute(k, v));
  return {width, height: whole, text: new XMLSerializer().serializeToString(copy)};
}
