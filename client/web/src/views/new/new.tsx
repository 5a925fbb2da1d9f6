// A new run: from a template, from another run, from nothing.

import {useMemo, useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain} from '../../api/errors';
import {templates, titleOf} from '../../api/templates';
import {asCli, asCurl, asPython, sweepAsPython, type Labels} from '../../model/copy_as';
import {labelsOf} from '../../model/job_list';
import {bytes, count, seconds} from '../../model/numbers';
import {requestId} from '../../ui/request_id';
import {go, setQuery, type Route} from '../../ui/route';
import {useAsync} from '../../ui/use_async';
import {Editor} from './editor';
import {useText} from './use_text';
import {useUndo} from './use_undo';
import {jobOf, useValidation, type Verdict} from './use_validation';

function Verdicts({problems, warnings, estimate, settled}: Verdict) {
  return (
    <div class="verdicts" role="status" data-settled={settled} data-problems={problems.length}>
      {problems.length > 0 && <ul>{problems.map(({line, path, text}, i) => (
        <li key={i} class="bad"><span aria-hidden="true">✗</span> {line > 0 && <strong>line {line}</strong>} {path && <code>{path}</code>} {text}</li>))}</ul>}
      {warnings.map((text) => <p key={text} class="warning"><span aria-hidden="true">⚠</span> {text}</p>)}
      {problems.length === 0 && settled && <p class="good">✓ The server accepts it.
        {estimate && <span class="soft"> About {count(estimate.samples)} samples, {bytes(estimate.outputBytes)}
          {estimate.steps > 0n && `, ${count(estimate.steps)} steps`}{estimate.wallTime && `, ${seconds(Number(estimate.wallTime.seconds) + estimate.wallTime.nanos / 1e9)}`}.</span>}</p>}
    </div>
  );
}

/** The page for Python; undefined while it is wrong, or where contactsim cannot make it. */
function pythonOf({page, problems, settled}: Verdict, labels: Labels): string | undefined {
  if (!page.json || problems.length > 0) return undefined;
  if (page.kind === 'scenario') return asPython(page.json, location.origin, labels);
  if (!settled) return undefined;
  const {spec} = jobOf(page);
  return spec.case === 'sweep' ? sweepAsPython(spec.value, location.origin, labels) : undefined;
}

function CopyAs({text, verdict, labels}: {text: string; verdict: Verdict; labels: Labels}) {
  const [shown, setShown] = useState('');
  const {page} = verdict;
  const wrong = !page.json || page.problems.length > 0;
  const python = useMemo(() => pythonOf(verdict, labels), [page, verdict.settled, verdict.problems, JSON.stringify(labels)]);
  const copy = (what: string) => {
    setShown(what);
    void navigator.clipboard?.writeText(what).catch(() => undefined);
  };
  return (
    <div><span class="group" role="group" aria-label="Copy as">Copy as
      <button type="button" onClick={() => copy(asCli(page.kind === 'sweep' ? JSON.stringify(page.json) : text, page.kind, location.origin, labels))} disabled={wrong}>CLI</button>
      <button type="button" onClick={() => copy(python!)} disabled={!python} title={page.kind === 'sweep' && !python ? 'contactsim makes grids of single fields; use the CLI' : ''}>Python</button>
      <button type="button" onClick={() => copy(asCurl(page.json!, page.kind, location.origin, labels))} disabled={wrong}>curl</button></span>
      {shown && <pre class="copied" tabIndex={0} aria-label="copied text">{shown}</pre>}
    </div>
  );
}

export function New({route}: {route: Route}) {
  const {text, setText, replaced, take} = useText(route);
  const {change, undo, redo, canUndo, canRedo, press} = useUndo(text, setText);
  const [chosen, setChosen] = useState('[]');
  const verdict = useValidation(text);
  const labels = route.query.get('labels') ?? '';
  const [error, setError] = useState('');
  const [busy, setBusy] = useState(false);
  const start = () => {
    setBusy(true);
    server.createJob({job: jobOf(verdict.page, labelsOf(labels)), requestId: requestId()}).then(
      ({name}) => go(`/runs/${name.replace('jobs/', '')}`),
      (e: unknown) => { setBusy(false); setError(explain(e)); });
  };
  const from = route.query.get('from');
  const Picture = useAsync(async () => (await import('./picture')).Picture, []).value;
  const Form = useAsync(async () => (await import('./form/form')).Form, []).value;
  const choose = (list: 'bodies' | 'contacts', name: string) => void import('../../model/form/place').then(({placeOf}) => {
    const place = placeOf(text, list, name);
    if (place) setChosen(JSON.stringify(place));
  });
  return (
    <>
      <div class="head"><h1>{from ? `Run ${from} again with changes` : 'New run'}</h1></div>
      <div class="new" onKeyDown={press}>
        <nav aria-label="Templates"><h2>Templates</h2><ul>{Object.keys(templates).sort().map((name) => (
          <li key={name}><button type="button" class="quiet" aria-pressed={text === templates[name]}
            onClick={() => take(name.replace('.yaml', ''))}>{titleOf(name)}</button></li>))}</ul></nav>
        <div>
          {replaced && <p class="notice" role="status">The template stands in place of what you wrote. <button type="button" onClick={() => history.back()}>Back to my text</button></p>}
          <div class="tools"><button type="button" disabled={!canUndo} onClick={undo}>Undo</button><button type="button" disabled={!canRedo} onClick={redo}>Redo</button></div>
          <Editor text={text} setText={(next) => change(next, 'editor')} problems={verdict.problems} />
          {Picture && <Picture verdict={verdict} choose={choose} />}
          <Verdicts {...verdict} />
          {error && <p class="notice" role="alert">{error}</p>}
          <div class="tools">
            <label>Labels <input value={labels} placeholder="key=value, …" onInput={(e) => setQuery({labels: e.currentTarget.value})} /></label>
            <button type="button" class="primary" disabled={busy || !verdict.settled || verdict.problems.length > 0} onClick={start}>{verdict.page.kind === 'sweep' ? 'Start the sweep' : 'Start the run'}</button>
            <CopyAs text={text} verdict={verdict} labels={labelsOf(labels)} />
          </div>
        </div>
        {Form && <Form text={text} change={change} problems={verdict.problems} chosen={chosen} choose={setChosen} />}
      </div>
    </>
  );
}
