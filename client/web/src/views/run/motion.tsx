// Plots over time, hysteresis and energy, with one window and one cursor.

import {useEffect, useMemo} from 'preact/hooks';

import look from '../../../../python/contactsim/figures/words.json';

import {bandsOf, type RunPart} from '../../model/curves';
import {derivedPanel, type Formula} from '../../model/derived';
import {MOST_CONTACTS, presetsFor, presetsShown, thinned, type Preset} from '../../model/presets';
import type {Mechanics} from '../../model/mechanics';
import {withMeasured, type Measured as MeasuredPoints} from '../../model/overlay';
import type {Cycle} from '../../api/generated/contact/v1/job_pb';
import type {Series} from '../../api/series';
import type {RunState} from '../../model/runState';
import {isFinal} from '../../api/watch';
import {Plot} from '../../plots/plot';
import type {Window} from '../../plots/range';
import {LeftOut} from '../../ui/left_out';
import {setQuery} from '../../ui/route';
import {Derived} from './derived';
import {useLoops} from './use_loops';
import {changed, covers, setWindow, windowOf} from './window';

interface Props {
  run: RunState;
  mechanics: Mechanics;
  series: Series | undefined;
  query: URLSearchParams;
  window: Window | undefined;
  /** The window that the plots show, that of the series. */
  drawn: Window | undefined;
  whole: Window;
  source: string;
  measured: MeasuredPoints | undefined;
  /** The cycles of a run that is over. */
  ended: Cycle[];
  formulas: Formula[];
}

/** The part of a scenario that fits a plot; `ended` are the cycles of a run that is over. Maps and waterfalls are of all bodies, or of every n-th. */
export function partFor({many}: Preset, mechanics: Mechanics, contact: string | null, all: boolean, ended: Cycle[]): Mechanics {
  return many ? thinned(mechanics, many, all, ended) : crop(mechanics, contact);
}

function crop(mechanics: Mechanics, contact: string | null): Mechanics {
  const {bodies, contacts} = mechanics;
  const chosen = contact ? contacts.filter(({name}) => name === contact) : contacts;
  if (chosen.length <= MOST_CONTACTS && bodies.length <= MOST_CONTACTS + 1 && !contact) return mechanics;
  const kept = chosen.slice(0, MOST_CONTACTS);
  const ends = new Set(kept.flatMap(({left, right}) => [left, right]).filter((i) => i >= 0));
  const order = [...ends].sort((a, b) => a - b);
  const place = (i: number) => (i < 0 ? -1 : order.indexOf(i));
  return {
    ...mechanics, bodies: order.map((i) => bodies[i]!),
    contacts: kept.map((c) => ({...c, left: place(c.left), right: place(c.right)})),
  };
}

/** What of a run lies in the window that the plots show. While it runs, it changes with the samples. */
function usePart({run, drawn, series}: Props): RunPart {
  return useMemo(() => {
    const inside = <T extends {startTimeS: number; endTimeS: number}>(list: T[]) =>
      (drawn ? list.filter((c) => c.endTimeS >= drawn[0] && c.startTimeS <= drawn[1]) : list);
    const cycles = inside(run.cycles);
    return {cycles, groups: inside(run.groups), series: series ?? new Map(), bands: bandsOf(cycles)};
  }, [series, isFinal(run.state) && run.cycles.length]);
}

const MAP_PX = 320;   // High enough for a row a pixel.

interface PresetProps {
  preset: Preset;
  mechanics: Mechanics;
  part: RunPart;
  contact: string | null;
  /** Whether all plots are shown. */
  all: boolean;
  ended: Cycle[];
  drawn: Window | undefined;
  measured: MeasuredPoints | undefined;
  source: string;
  /** What to say where nothing is drawn. */
  empty: string;
}

function PresetPlot({preset, mechanics: whole, part, contact, all, ended, measured, drawn, ...rest}: PresetProps) {
  const mechanics = useMemo(() => partFor(preset, whole, contact, all, ended), [whole, contact, all, ended]);
  const panel = useMemo(() => preset.panel({mechanics, ...part}), [part, mechanics]);
  const shown = useMemo(() => withMeasured(panel, measured, drawn), [panel, measured, drawn?.[0], drawn?.[1]]);
  return <Plot panel={shown} window={drawn} onZoom={setWindow} source={rest.source} empty={rest.empty} {...(preset.many ? {height: MAP_PX} : {})} />;
}

function DerivedPlot({formula, mechanics: whole, part, contact, drawn, source, empty}: Omit<PresetProps, 'preset' | 'all' | 'ended' | 'measured'> & {formula: Formula}) {
  const mechanics = useMemo(() => crop(whole, contact), [whole, contact]);
  const panel = useMemo(() => derivedPanel(formula, {mechanics, ...part}), [formula, mechanics, part]);
  return <Plot panel={panel} window={drawn} onZoom={setWindow} source={source} empty={empty} />;
}

/** Zoom by buttons and keys, for those who do not drag. */
function Zoom({query, window, whole, live}: {query: URLSearchParams; window: Window | undefined; whole: Window; live: boolean}) {
  // From the address: keys may come faster than the page is drawn.
  const now = () => windowOf(new URLSearchParams(location.search), whole[1]) ?? whole;
  const zoom = (factor: number, move = 0) => {
    const next = changed(now(), factor, move);
    setWindow(factor > 1 && covers(next, whole) ? undefined : next);
  };
  useEffect(() => {
    const keys: Record<string, () => void> = {
      '+': () => zoom(0.5), '=': () => zoom(0.5), '-': () => zoom(2), '0': () => setWindow(undefined),
      '[': () => zoom(1, -0.25), ']': () => zoom(1, 0.25),
    };
    const press = (event: KeyboardEvent) => {
      if (event.ctrlKey || event.metaKey || (event.target as Element).closest('input, select, textarea')) return;
      keys[event.key]?.();
    };
    addEventListener('keydown', press);
    return () => removeEventListener('keydown', press);
  });
  return (
    <span class="group" role="group" aria-label="Zoom of all plots over time">
      <button type="button" title="key +" onClick={() => zoom(0.5)}>Zoom in</button>
      <button type="button" title="key −" onClick={() => zoom(2)}>Zoom out</button>
      <button type="button" title="key [" aria-label="Earlier" onClick={() => zoom(1, -0.25)}>◀</button>
      <button type="button" title="key ]" aria-label="Later" onClick={() => zoom(1, 0.25)}>▶</button>
      <button type="button" title="key 0" disabled={!window} onClick={() => setWindow(undefined)}>All</button>
      {live && <label><input type="checkbox" checked={query.has('follow')}
        onChange={(e) => setQuery({follow: e.currentTarget.checked ? '1' : undefined})} /> follow</label>}
    </span>
  );
}

/** What the plots leave out of a large scenario. */
function Cropped({mechanics, contact}: {mechanics: Mechanics; contact: string | null}) {
  const {bodies, contacts} = useMemo(() => crop(mechanics, contact), [mechanics, contact]);
  const way = contact ? '' : 'choose a contact in the ledger';
  return (
    <>
      <LeftOut shown={contacts.length} all={mechanics.contacts.length} what="contacts" way={way} />
      <LeftOut shown={bodies.length} all={mechanics.bodies.length} what="bodies" />
    </>
  );
}

/** Which plots there are, in the order in which they are chosen. */
function Choice({mechanics, shown}: {mechanics: Mechanics; shown: string[]}) {
  const toggle = (id: string, on: boolean) => setQuery({plots: [...shown.filter((other) => other !== id), ...(on ? [id] : [])].join(',')});
  return (
    <details class="choice"><summary>Choose plots</summary>
      {presetsFor(mechanics).map(({id}) => <label key={id}><input type="checkbox" checked={shown.includes(id)} onChange={(e) => toggle(id, e.currentTarget.checked)} /> {look.titles[id as keyof typeof look.titles]}</label>)}
    </details>
  );
}

export function Motion(props: Props) {
  const {mechanics, query, window, drawn, whole, run, source, measured, ended, formulas} = props;
  const chosen = query.get('plots') ?? '';
  const all = chosen !== '';
  const contact = query.get('contact');
  const part = usePart(props);
  const loops = useLoops(run.job!.name, useMemo(() => crop(mechanics, contact), [mechanics, contact]), part, isFinal(run.state));
  const looped = useMemo(() => ({...part, loops}), [part, loops]);
  const empty = isFinal(run.state) && part.series.size > 0 ? 'Nothing recorded here.' : 'Waiting for samples …';
  const plots = useMemo(() => presetsShown(mechanics, chosen, measured).map((preset) => (
    <PresetPlot key={preset.id} {...{preset, mechanics, contact, all, ended, drawn, measured, source, empty}} part={preset.id === 'hysteresis' ? looped : part} />)), [mechanics, chosen, contact, ended, looped, drawn, measured, source, empty]);
  return (
    <section aria-label="Motion">
      <div class="tools"><h2>Motion</h2>
        <Zoom query={query} window={window} whole={whole} live={!isFinal(run.state)} />
        {window && <span class="soft mono">{window[0]} … {window[1]} s</span>}
        <label><input type="checkbox" checked={chosen === 'all'} onChange={(e) => setQuery({plots: e.currentTarget.checked ? 'all' : undefined})} /> more plots</label>
        <Choice mechanics={mechanics} shown={presetsShown(mechanics, chosen, measured).map(({id}) => id)} />
        <Derived mechanics={mechanics} shown={formulas.map(({text}) => text)} />
        <Cropped mechanics={mechanics} contact={contact} />
        <span class="soft hint">drag in a plot to zoom, double-click to see all</span>
      </div>
      <div class="plots">{plots}{formulas.map((formula) => <DerivedPlot key={formula.text} {...{formula, mechanics, part, contact, drawn, source, empty}} />)}</div>
    </section>
  );
}
