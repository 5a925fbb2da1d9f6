// The key of a plot: names, values at the cursor, and switches.

import type {Curve, Panel} from '../model/panel';
import {colourOf, dashOf, useTheme} from '../ui/theme';
import {dotted, lines} from './build';
import type {Reading} from './moment';

const MOST = 24;

interface Props {
  panel: Panel;
  hidden: Set<string>;
  setHidden: (hidden: Set<string>) => void;
  reading: Reading;
}

function Swatch({curve}: {curve: Curve}) {
  const theme = useTheme();
  const dash = curve.mark === 'dashed' ? [4, 3] : dashOf(curve.colour);
  return (
    <svg class="swatch" width="22" height="8" aria-hidden="true">
      {curve.mark === 'points' || curve.mark === 'rare' ? [3, 11, 19].map((x) => <circle key={x} cx={x} cy="4" r="2.2" fill={colourOf(curve.colour, theme)} />)
        : <line x1="0" y1="4" x2="22" y2="4" stroke={colourOf(curve.colour, theme)} stroke-width="2" stroke-dasharray={dash.join(' ')} />}
    </svg>
  );
}

export function Key({panel, hidden, setHidden, reading}: Props) {
  const curves = panel.overTime ? [...lines(panel), ...dotted(panel)] : panel.curves.filter(({keyed, mark}) => keyed !== false && (mark === 'line' || mark === 'rare'));
  const toggle = (label: string) => {
    const next = new Set(hidden);
    if (!next.delete(label)) next.add(label);
    setHidden(next);
  };
  return (
    <div class="key">
      {curves.slice(0, MOST).map((curve, i) => (
        <button type="button" key={curve.label} aria-pressed={!hidden.has(curve.label)}
          onClick={() => toggle(curve.label)} title="show or hide">
          <Swatch curve={curve} />
          {curve.label}
          <output ref={(at) => { reading.values[i] = at; }} />
        </button>
      ))}
      {curves.length > MOST && <span class="soft">and {curves.length - MOST} more</span>}
      {panel.overTime && <span class="soft" ref={(at) => { reading.unit = at; }} />}
    </div>
  );
}
