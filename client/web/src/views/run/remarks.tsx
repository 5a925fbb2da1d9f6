// Labels and note of a run, and their changing. What is typed is kept until it is stored or dropped.

import {useEffect, useRef, useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain} from '../../api/errors';
import type {Job} from '../../api/generated/contact/v1/job_pb';
import {labelChangeOf, labelsText, MOST_NOTE, plainLabels, TITLE, type Labels} from '../../model/remarks';

const MOST_LETTERS = 63;   // Of a label, see Job.labels.

interface Said {
  labels: Labels;
  note: string;
}

/** What is typed. */
interface Draft {
  title: string;
  labels: string;
  note: string;
}

const draftFrom = ({labels, note}: Said): Draft => ({title: labels[TITLE] ?? '', labels: labelsText(labels), note});
const draftKey = (name: string) => `remarks ${name}`;

/** What was typed and not stored, also before the page was left. */
function draftOf(name: string): Draft | undefined {
  const kept = sessionStorage.getItem(draftKey(name));
  return kept === null ? undefined : JSON.parse(kept) as Draft;
}

export function Remarks({job, onLabels}: {job: Job; onLabels: (labels: Labels) => void}) {
  const {name} = job;
  const [said, setSaid] = useState<Said>(job);
  const [draft, setDraft] = useState(() => draftOf(name));
  const [error, setError] = useState('');
  useEffect(() => onLabels(said.labels), [said]);
  useEffect(() => setSaid(job), [job.name, job.note, JSON.stringify(job.labels)]);
  const others = useRef<BroadcastChannel>();
  useEffect(() => {   // Other pages of this browser tell at once; of others this one hears when it is looked at.
    const channel = others.current = new BroadcastChannel(draftKey(name));
    const renew = () => { server.getJob({name}).then(setSaid, () => undefined); };
    const look = () => { if (document.visibilityState === 'visible') renew(); };
    channel.onmessage = renew;
    document.addEventListener('visibilitychange', look);
    return () => { channel.close(); document.removeEventListener('visibilitychange', look); };
  }, [name]);
  useEffect(() => {
    if (draft) sessionStorage.setItem(draftKey(name), JSON.stringify(draft));
    else sessionStorage.removeItem(draftKey(name));
  }, [name, draft]);
  const type = (part: Partial<Draft>) => {
    const next = {...draft!, ...part};
    sessionStorage.setItem(draftKey(name), JSON.stringify(next));   // At once: the page may be left before the effect above runs.
    setDraft(next);
  };
  const fail = (why: unknown) => setError(explain(why));
  const begin = () => {
    setError('');
    setDraft(draftFrom(said));
    server.getJob({name}).then((newest) => {   // Others may have changed it since.
      setSaid(newest);
      setDraft((now) => (JSON.stringify(now) === JSON.stringify(draftFrom(said)) ? draftFrom(newest) : now));
    }, fail);
  };
  const store = (event: Event) => {
    event.preventDefault();
    const {set, removed, wrong} = labelChangeOf(draft!.labels);   // All of them: one goes when it is not written.
    const none = [...wrong, ...removed.map((key) => `${key}-`)];
    if (none.length > 0) { setError(`${none.join(', ')}: write labels as key=value`); return; }
    const labels = {...(draft!.title ? {[TITLE]: draft!.title} : {}), ...set};
    server.updateJob({job: {name, labels, note: draft!.note}, updateMask: {paths: ['labels', 'note']}, expectedUid: job.uid}).then(
      (newest) => {
        setSaid(newest);
        setDraft(undefined);
        setError('');
        others.current?.postMessage('stored');
      }, fail);
  };
  if (!draft) {
    return (
      <section class="remarks" aria-label="Labels and note">
        {plainLabels(said.labels).map(([key, value]) => <span key={key} class="label">{key}={value}</span>)}
        {said.note && <p class="said">{said.note}</p>}
        <button type="button" class="quiet" onClick={begin}>{said.note || Object.keys(said.labels).length > 0 ? 'Rename, change labels and note' : 'Rename, add labels or a note'}</button>
      </section>
    );
  }
  return (
    <form class="remarks" aria-label="Labels and note" onSubmit={store}>
      <label>Title <input value={draft.title} placeholder={job.title} maxLength={MOST_LETTERS} spellcheck={false} onInput={(e) => type({title: e.currentTarget.value.replaceAll(' ', '_')})} /></label>
      <label>Labels <input value={draft.labels} placeholder="key=value, …" spellcheck={false} onInput={(e) => type({labels: e.currentTarget.value})} /></label>
      <label>Note <textarea value={draft.note} rows={Math.min(Math.max(draft.note.split('\n').length + 1, 3), 12)} maxLength={MOST_NOTE} onInput={(e) => type({note: e.currentTarget.value})} /></label>
      <span class="group"><button type="submit" class="primary">Store</button>
        <button type="button" onClick={() => { setDraft(undefined); setError(''); }}>Drop changes</button></span>
      {error && <p class="bad" role="alert">{error}</p>}
    </form>
  );
}
