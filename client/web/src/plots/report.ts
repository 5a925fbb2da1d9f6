// What a page shows, as a page of its own that needs no network: its figures are zoomed and tell their values there.

import living from '../../../python/contactsim/figures/living.js?raw';
import {drawings} from './exports';

const STYLE = `body{font:15px/1.45 system-ui,sans-serif;max-width:76rem;margin:2rem auto;padding:0 1rem;color:#1a1a1a;background:#fff}
h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:2rem}.tools,.facts{margin:.4rem 0}.soft,.note,.facts{color:#57606a}.warning,.bad{color:#8a5300}
table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:.82rem}.scroll{overflow-x:auto}th,td{padding:.2rem .5rem;text-align:left;border-bottom:1px solid #ddd}.number{text-align:right;white-space:nowrap}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,34rem),1fr));gap:1rem}figure{margin:0}svg{max-width:100%;height:auto}.said{white-space:pre-wrap}.label,.badge{border:1px solid #d5d9df;border-radius:4px;padding:0 .3rem;margin-right:.3rem;white-space:nowrap}dt{white-space:nowrap}
pre{background:#f5f5f5;padding:.7rem;overflow-x:auto;font-size:.82rem}dl div{display:flex;gap:1rem;justify-content:space-between;max-width:52rem;border-bottom:1px solid #eee}dd{margin:0}`;
// What people do on the page, and what is there only while they do it.
const GONE = 'button, form, input, select, label, progress, dialog, canvas, .button, .strip, .drop:not(:has(table)), .group, .hint, .pointed, .hidden, div:has(> .files), details:not([open]), summary';
const HINT = 'Drag in a figure to zoom, double-click to see all of it; + − 0 and arrows do so, too. A point tells its values, read off the drawing.';
const escape = (text: string) => text.replace(/[&<>"]/g, (c) => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'})[c]!);

/** A drawing with names of its own, which a page has once. */
const alone = (svg: string, place: number) => svg.replaceAll(/\b(id="|url\(#)(?=in"|in\)|cut"|cut\)|hatch"|hatch\))/g, `$1f${place}-`);

/** The page; `repeat` tells how to come to the same. */
export function reportOf(main: Element, repeat: string): string {
  const copy = main.cloneNode(true) as Element;
  const figures = [...main.querySelectorAll('figure')];
  copy.querySelectorAll('figure').forEach((figure, place) => {
    const svg = drawings.get(figures[place]!)?.();
    figure.innerHTML = svg ? alone(svg.text, place) : '';
  });
  for (const button of copy.querySelectorAll('td button')) button.replaceWith(button.textContent ?? '');
  for (const gone of copy.querySelectorAll(GONE)) gone.remove();
  for (const link of copy.querySelectorAll<HTMLAnchorElement>('a[href]')) link.setAttribute('href', link.href);   // With the server.
  return `<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<title>${escape(document.title)}</title><style>${STYLE}</style></head><body>
${copy.innerHTML}
<h2>How to repeat it</h2><pre>${escape(repeat)}</pre><p>${HINT}</p>
<script>
${living}</script></body></html>
`;
}
