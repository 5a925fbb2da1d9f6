// Where a file of measurements is chosen, or dropped on the page of a run.

import {useEffect, useState} from 'preact/hooks';

import type {Measured} from '../../../model/overlay';
import {count} from '../../../model/numbers';
import {useAsync} from '../../../ui/use_async';

interface Props {
  name: string;
  /** The last simulated time [s]. */
  end: number;
  query: URLSearchParams;
  onMeasured: (measured: Measured | undefined) => void;
}

/** A file that was read. */
export interface Given {
  name: string;
  bytes: Uint8Array;
}

const MOST_BYTES = 200e6;

/** Takes files that are dropped anywhere on the page; true while one is held above it. */
function useDrop(take: (file: File) => void): boolean {
  const [above, setAbove] = useState(false);
  useEffect(() => {
    const control = new AbortController();
    const on = (name: 'dragover' | 'dragleave' | 'drop', act: (event: DragEvent) => void) => addEventListener(name, (event) => {
      if (event.dataTransfer?.types.includes('Files')) act(event);
    }, control);
    on('dragover', (event) => { event.preventDefault(); setAbove(true); });
    on('dragleave', () => setAbove(false));
    on('drop', (event) => {
      event.preventDefault();
      setAbove(false);
      if (event.dataTransfer!.files[0]) take(event.dataTransfer!.files[0]);
    });
    return () => control.abort();
  }, []);
  return above;
}

/** Chosen by mouse or keys, or dropped; a file that has changed may be chosen again. */
export function Measurements({name, end, query, onMeasured}: Props) {
  const [given, setGiven] = useState<Given>();
  const [error, setError] = useState('');
  const take = (file: File) => {
    setError(file.size > MOST_BYTES ? `${file.name} has more than ${count(MOST_BYTES / 1e6)} MB; contactctl compare reads it` : '');
    if (file.size > MOST_BYTES) return;
    file.arrayBuffer().then((bytes) => setGiven({name: file.name, bytes: new Uint8Array(bytes)}), (why: Error) => setError(`${file.name}: ${why.message}`));
  };
  const above = useDrop(take);
  const view = useAsync(async () => (given ? (await import('./comparison')).Comparison : undefined), [!given]);
  const Comparison = view.value;
  return (
    <section aria-label="Measurements" class={above ? 'drop above' : 'drop'}>
      <div class="tools"><h2>Measurements</h2>
        <label>CSV beside this run <input type="file" accept=".csv,.txt,.dat,.tsv,.asc,text/*"
          onClick={(e) => { e.currentTarget.value = ''; }} onChange={(e) => { const [file] = e.currentTarget.files ?? []; if (file) take(file); }} /></label>
        <span class="soft hint">or drop it on the page; it stays in the browser</span>
        {given && <button type="button" onClick={() => { setGiven(undefined); onMeasured(undefined); }}>Take it away</button>}
      </div>
      {error && <p class="notice" role="alert">{error}</p>}
      {given && Comparison && <Comparison key={name} name={name} end={end} given={given} query={query} onMeasured={onMeasured} />}
    </section>
  );
}
