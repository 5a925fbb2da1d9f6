// The text of the editor. The address holds it as far as it differs from what it was made of, so that a reload, a link
// and Back bring it again.

import {toJson} from '@bufbuild/protobuf';
import {useEffect, useLayoutEffect, useRef, useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain} from '../../api/errors';
import {ScenarioSchema, SweepSchema} from '../../api/generated/contact/v1/scenario_pb';
import {templates} from '../../api/templates';
import {go, type Route} from '../../ui/route';
import {useAsync} from '../../ui/use_async';

const FIRST = 'three-ball-chain';
const KEEP_MS = 400;   // Browsers refuse addresses that change much more often.
const MARK = '#text=';

/** The text of another job. */
async function textOf(id: string): Promise<string> {
  const {stringify} = await import('yaml');
  const {spec} = await server.getJob({name: `jobs/${id}`});
  if (spec.case === 'scenario') return stringify(toJson(ScenarioSchema, spec.value, {useProtoFieldName: true}));
  return spec.case === 'sweep' ? stringify(toJson(SweepSchema, spec.value, {useProtoFieldName: true})) : '';
}

const heldIn = (hash: string) => (hash.startsWith(MARK) ? decodeURIComponent(hash.slice(MARK.length)) : undefined);

interface Text {
  text: string;
  setText: (text: string) => void;
  /** True while a template stands in place of a text that was changed. */
  replaced: boolean;
  /** Puts a template in place of the text, which is one step back from then on. */
  take: (template: string) => void;
}

export function useText({query, hash}: Route): Text {
  const from = query.get('from') ?? '';
  const template = query.get('template') ?? FIRST;
  const {value: read, error} = useAsync(async () => (from ? textOf(from) : ''), [from]);
  const origin = (from ? read : templates[`${template}.yaml`]) ?? '';
  const [text, setText] = useState(heldIn(hash) ?? origin);
  const [replacedBy, setReplacedBy] = useState('');
  const source = `${from} ${template}`;
  const known = useRef(source + hash);
  useEffect(() => { if (error !== undefined) setText(`# ${explain(error)}\n`); }, [error]);
  useEffect(() => { if (read) setText((now) => now || read); }, [read]);
  useLayoutEffect(() => {   // An address that this page did not make has a text of its own.
    if (known.current !== source + hash) setText(heldIn(hash) ?? origin);
    known.current = source + hash;
  }, [source, hash]);
  const keep = () => {
    const held = text === origin || text === '' ? '' : MARK + encodeURIComponent(text);
    known.current = source + held;
    go(location.pathname + location.search + held, true);
  };
  useLayoutEffect(() => {
    const timer = setTimeout(keep, KEEP_MS);
    document.addEventListener('click', keep, true);   // Before it leads elsewhere.
    return () => { clearTimeout(timer); document.removeEventListener('click', keep, true); };
  }, [text, origin]);
  const take = (name: string) => {
    keep();
    setReplacedBy(text !== origin && text !== '' ? name : '');
    const labels = query.get('labels');
    go(`/new?${new URLSearchParams({template: name, ...(labels ? {labels} : {})}).toString()}`);
  };
  return {text, setText, take, replaced: replacedBy === template && text === origin};
}
