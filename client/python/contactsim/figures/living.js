// Zoom and values in the figures of a page that needs no network, for contactsim and the dashboard alike. An element with
// `data-axes` tells of each pair of axes its box in the drawing, from where to where they go in the numbers that stand at
// them, whether as powers, their names, and the size of letters. What is clipped to the box is zoomed; a curve has its name
// in `data-name`; ticks and labels, of the classes `tick` and `label`, give way while it is.
'use strict';
(() => {
  const NEAR = 30, STILL = 4, TICKS = 6;   // In units of the drawing; about as many ticks.
  const KEYS = {'+': [0.25, 0.75], '=': [0.25, 0.75], '-': [-0.5, 1.5], ArrowLeft: [-0.25, 0.75], ArrowRight: [0.25, 1.25]};
  const whole = () => ({x: [0, 1], y: [0, 1]});
  const span = ([from, to]) => to - from;
  const inside = (range, part) => range[0] + part * span(range);
  const valueAt = ([low, high, log], part) => (log ? low * (high / low) ** part : low + part * (high - low));
  const partOf = ([low, high, log], value) => (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
  const short = (value) => String(Number(value.toPrecision(4))).replace('-', '−');
  const said = (name, value) => name.replace(/ ?\[(.*)\]$|$/, (_all, unit) => ` ${short(value)}${unit && unit !== '1' ? ` ${unit}` : ''}`);

  function ticksOf(scale, view) {
    const [low, high] = view.map((part) => valueAt(scale, part));
    if (scale[2] && high > 10 * low) {
      const powers = [];
      const every = Math.ceil(Math.log10(high / low) / TICKS);
      for (let power = Math.ceil(Math.log10(low)); 10 ** power <= high; power += every) powers.push([10 ** power, `1e${power}`]);
      return powers;
    }
    const raw = (high - low) / TICKS;
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find((part) => part * power >= raw) * power;
    const digits = Math.min(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), 20);
    const ticks = [];
    for (let i = Math.ceil(low / step); i * step <= high; ++i) ticks.push([i * step, (i * step).toFixed(digits).replace('-', '−')]);
    return ticks;
  }

  function live(svg, {box: [left, top, width, height], x, y, names, size}) {
    const make = (name, attributes, into, text) => {
      const made = document.createElementNS(svg.namespaceURI, name);
      for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
      if (text) made.textContent = text;
      into?.append(made);
      return made;
    };
    const clipOf = (element) => document.getElementById(/#([^")]+)/.exec(element.getAttribute('clip-path'))?.[1])?.querySelector('rect');
    const own = [...svg.querySelectorAll('[clip-path]')].filter((element) => {
      const rect = clipOf(element);
      return rect && Math.abs(rect.x.baseVal.value - left) < 1 && Math.abs(rect.y.baseVal.value - top) < 1;
    });
    if (own.length === 0) return;
    const root = own[0].closest('[id*="axes_"]') ?? svg;
    const moved = own.map((element) => {
      const frame = make('g', {'clip-path': element.getAttribute('clip-path')});
      element.replaceWith(frame);
      element.removeAttribute('clip-path');
      const inner = make('g', {}, frame);
      inner.append(element);
      return inner;
    });
    const all = (what) => moved.flatMap((inner) => [...inner.querySelectorAll(what)]);
    for (const path of all('path, rect')) path.setAttribute('vector-effect', 'non-scaling-stroke');
    const marks = all('use').filter((use) => use.getAttribute('x') !== '0').map((use) => [use, use.x.baseVal.value, use.y.baseVal.value]);
    const points = all('[data-name] path, path[data-name]').flatMap((path) => [...path.getAttribute('d').matchAll(/[ML]\s*(-?[\d.]+)[ ,](-?[\d.]+)/g)]
      .map(([, a, b]) => [Number(a), Number(b), path.closest('[data-name]').dataset.name]));
    for (const [use, a, b] of marks) if (use.closest('[data-name]')) points.push([a, b, use.closest('[data-name]').dataset.name]);

    let view = whole();   // In parts of the box, y from the bottom.
    let from;
    const ticks = make('g', {'font-size': size, fill: 'currentColor'}, root);
    const chosen = make('rect', {fill: '#0072B2', 'fill-opacity': 0.15, 'pointer-events': 'none'}, svg);
    const ring = make('circle', {r: 4, fill: 'none', stroke: 'currentColor', 'pointer-events': 'none', visibility: 'hidden'}, svg);
    const words = make('text', {x: left + width / 2, y: top + 1.3 * size, 'text-anchor': 'middle', 'font-size': size, fill: 'currentColor',
      stroke: '#fff', 'stroke-width': 4, 'paint-order': 'stroke', 'pointer-events': 'none'}, svg);
    const field = make('rect', {x: left, y: top, width, height, fill: 'none', 'pointer-events': 'all', tabindex: 0, role: 'application',
      'aria-label': `${names.join(', ')}: drag to zoom, double-click to see all; keys + − 0 and arrows`}, svg);
    const toX = (part) => left + width * (part - view.x[0]) / span(view.x);
    const toY = (part) => top + height * (view.y[1] - part) / span(view.y);

    function show() {
      const [sx, sy] = [1 / span(view.x), 1 / span(view.y)];
      for (const inner of moved) inner.setAttribute('transform', `matrix(${sx} 0 0 ${sy} ${left - sx * (left + view.x[0] * width)} ${top - sy * (top + (1 - view.y[1]) * height)})`);
      for (const [use, a, b] of marks) use.setAttribute('transform', `translate(${a} ${b}) scale(${1 / sx} ${1 / sy}) translate(${-a} ${-b})`);
      const zoomed = sx !== 1 || sy !== 1 || view.x[0] !== 0;
      root.classList.toggle('zoomed', zoomed);
      ticks.replaceChildren();
      if (!zoomed) return;
      for (const [value, text] of ticksOf(x, view.x)) make('text', {x: toX(partOf(x, value)), y: top + height + 1.4 * size, 'text-anchor': 'middle'}, ticks, text);
      for (const [value, text] of ticksOf(y, view.y)) make('text', {x: left - 0.5 * size, y: toY(partOf(y, value)) + 0.35 * size, 'text-anchor': 'end'}, ticks, text);
    }
    const look = (next) => { view = next; point(); show(); };
    const at = (event) => {   // In parts of what is shown, from the left and from the bottom.
      const {x: a, y: b} = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      return [Math.min(Math.max((a - left) / width, 0), 1), Math.min(Math.max(1 - (b - top) / height, 0), 1)];
    };
    /** Tells the point that is close to a place, if there is one. */
    function point(place) {
      let [least, near] = [NEAR ** 2, undefined];
      for (const [a, b, name] of place ? points : []) {
        const [px, py] = [(a - left) / width, 1 - (b - top) / height];
        const distance = ((px - inside(view.x, place[0])) / span(view.x) * width) ** 2 + ((py - inside(view.y, place[1])) / span(view.y) * height) ** 2;
        if (distance < least) [least, near] = [distance, [px, py, name]];
      }
      ring.setAttribute('visibility', near ? 'visible' : 'hidden');
      words.textContent = near ? `${near[2]}: ${said(names[0], valueAt(x, near[0]))}, ${said(names[1], valueAt(y, near[1]))}` : '';
      if (near) for (const [key, value] of [['cx', toX(near[0])], ['cy', toY(near[1])]]) ring.setAttribute(key, value);
    }
    /** What a drag from one place to another chooses: a stretch of x if it is flat, one of y if it is upright. */
    function choice(to) {
      const sides = [[width, 0, view.x], [height, 1, view.y]].map(([long, i, range]) => {
        const ends = [from[i], to[i]].sort((a, b) => a - b);
        return long * span(ends) > 3 * STILL ? ends.map((part) => inside(range, part)) : range;
      });
      return {x: sides[0], y: sides[1]};
    }
    field.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || event.pointerType === 'touch') return;
      from = at(event);
      field.setPointerCapture(event.pointerId);
    });
    field.addEventListener('pointermove', (event) => {
      point(at(event));
      if (!from) return;
      const next = choice(at(event));
      const [a, b] = [toX(next.x[0]), toY(next.y[1])];
      for (const [key, value] of Object.entries({x: a, y: b, width: toX(next.x[1]) - a, height: toY(next.y[0]) - b})) chosen.setAttribute(key, value);
    });
    field.addEventListener('pointerup', (event) => {
      const next = from && choice(at(event));
      from = undefined;
      chosen.setAttribute('width', 0);
      if (next && (next.x !== view.x || next.y !== view.y)) look(next);
    });
    field.addEventListener('pointerleave', () => point());
    field.addEventListener('dblclick', () => look(whole()));
    field.addEventListener('keydown', (event) => {
      const step = KEYS[event.key];
      if (!step && event.key !== '0' && event.key !== 'Escape') return;
      event.preventDefault();
      const next = step?.map((part) => inside(view.x, part));
      const range = next && span(next) < 1 ? next.map((part) => part - Math.min(next[0], 0) - Math.max(next[1] - 1, 0)) : [0, 1];
      look(step ? {...view, x: range} : whole());
    });
  }

  document.head.append(Object.assign(document.createElement('style'), {textContent: '.zoomed .tick,.zoomed .label{display:none}[data-axes] svg,svg[data-axes]{overflow:visible}rect[tabindex]:focus{outline:none}rect[tabindex]:focus-visible{stroke:currentColor}'}));
  for (const owner of document.querySelectorAll('[data-axes]')) {
    for (const axes of JSON.parse(owner.dataset.axes)) live(owner.closest('svg') ?? owner.querySelector('svg'), axes);
  }
})();
