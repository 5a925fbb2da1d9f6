// A file of measurements beside a run: what its columns are, the shift of its clock, and the verdict.

import {useEffect, useMemo, useState} from 'preact/hooks';

import {explain} from '../../../api/errors';
import {readAll, recordedColumns, type Series} from '../../../api/series';
import {measuredAsCli} from '../../../model/copy_as';
import {fitShift, overlapping, rowOf, type Range} from '../../../model/measured/comparison';
import {guessed, mapsOf, signalsOf, TIME, type Known, type Meaning, type Signal} from '../../../model/measured/signals';
import {Table} from '../../../model/measured/table';
import {byTime, type Measured} from '../../../model/overlay';
import {count} from '../../../model/numbers';
import {Copy} from '../../../ui/copy';
import {useAsync} from '../../../ui/use_async';
import {Columns} from './columns';
import type {Given} from './drop';
import {Shift, Tolerances, Verdict} from './verdict';

interface Props {
  name: string;
  end: number;
  given: Given;
  query: URLSearchParams;
  onMeasured: (measured: Measured | undefined) => void;
}

/** What is made of what was given, or why nothing is. */
function attempt<T>(make: () => T): {value?: T; error?: string} {
  try {
    return {value: make()};
  } catch (error) {
    return {error: (error as Error).message};
  }
}

/** A number of the address; undefined if it has none. */
function numberIn(query: URLSearchParams, name: string): number | undefined {
  const value = Number(query.get(name) ?? NaN);
  return Number.isFinite(value) ? value : undefined;
}

function rangeIn(query: URLSearchParams): Range | undefined {
  const [low = NaN, high = NaN] = (query.get('within') ?? '').split(':').map(Number);
  return low < high ? [low, high] : undefined;
}

/** The measured signals with the run, once its samples are there. */
function Compared({name, given, signals, series, query, maps, onMeasured}: Omit<Props, 'end'> & {signals: Signal[]; series: Series; maps: string[] | undefined}) {
  const set = numberIn(query, 'shift');
  const within = useMemo(() => rangeIn(query) ?? overlapping(signals, series), [query.get('within'), signals, series]);
  const fitted = useMemo(() => (set === undefined ? fitShift(signals, series, within) : undefined), [signals, series, within, set]);
  const shift = set ?? fitted ?? 0;
  const tolerance = {relative: numberIn(query, 'rel') ?? 0.05, absolute: numberIn(query, 'abs') ?? 0};
  const rows = useMemo(() => signals.map((signal) => rowOf(signal, series, shift, tolerance)), [signals, series, shift, tolerance.relative, tolerance.absolute]);
  useEffect(() => onMeasured(new Map(signals.map(({channel, times, values}) => [channel, byTime(times, values, shift)]))), [signals, shift]);
  const command = maps && measuredAsCli({job: name, file: given.name, maps, shift: set, within, ...tolerance}, location.origin);
  return (
    <>
      <div class="tools"><Shift shift={shift} set={set} within={within} found={set !== undefined || fitted !== undefined} /><Tolerances query={query} /></div>
      <Verdict rows={rows} shift={shift} />
      {command && <div class="ready"><code>{command}</code> <Copy text={command} what="the command" /></div>}
    </>
  );
}

export function Comparison(props: Props) {
  const {name, end, given, onMeasured} = props;
  const {value: table, error: unread} = useMemo(() => attempt(() => new Table(given.bytes)), [given]);
  const {value: known, error: unknown} = useAsync(() => recordedColumns(name), [name]);
  const channels = useMemo((): Known[] => (known ?? []).filter((column) => column.name !== TIME.name), [known]);
  const [changed, setChanged] = useState<{table: Table; meanings: Meaning[]}>();
  const meanings = useMemo(() => (changed && changed.table === table ? changed.meanings : guessed(table?.columns ?? [], channels)), [changed, table, channels]);
  const {value: signals, error: wrong} = useMemo(() => attempt(() => (table && known ? signalsOf(table, meanings, channels) : [])), [table, known, meanings]);
  const names = (signals ?? []).map(({channel}) => channel);
  const {value: series, error: lost} = useAsync(async () => (names.length > 0 ? readAll(name, names, 0, end) : undefined), [names.join('\n'), end]);
  const ready = series && names.length > 0 && names.every((channel) => series.has(channel));
  useEffect(() => { if (!ready) onMeasured(undefined); }, [ready]);
  const error = unread ?? wrong ?? (unknown || lost ? explain(unknown ?? lost) : undefined);
  return (
    <>
      {table && <p class="soft">{given.name}: {count(table.rows)} rows of {table.columns.length} columns, {table.dialect}</p>}
      {table && known && <Columns table={table} channels={channels} meanings={meanings} change={(next) => setChanged({table, meanings: next})} />}
      {error && <p class="notice" role="alert">{given.name}: {error}</p>}
      {known && !error && names.length === 0 && <p class="notice" role="status">No column is a channel of this run yet: choose one for each that was measured.</p>}
      {ready && signals && !error && <Compared {...props} signals={signals} series={series} maps={mapsOf(table!.columns, meanings, channels)} />}
    </>
  );
}
