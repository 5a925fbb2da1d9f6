// The same contact in other simulators: their parameters, and what each of them really delivers.

import type {ModelTranslation} from '../../api/generated/contact/v1/model_service_pb';
import {commandOf, inputsOf, queryOf, requestOf, wordsAmong} from '../../model/translation';
import {count} from '../../model/numbers';
import {LeftOut} from '../../ui/left_out';
import {Copy} from '../../ui/copy';
import {setQuery, type Route} from '../../ui/route';
import {Inputs} from './inputs';
import {Rebounds, Translations} from './results';
import {useTranslation} from './use_translation';
import './translate.css';

function found(all: readonly ModelTranslation[], words: string): ModelTranslation[] {
  const wanted = words.toLowerCase().split(/\s+/);
  return all.filter(({model, title}) => wanted.every((word) => `${model} ${title}`.toLowerCase().includes(word)));
}

export function Translate({route: {query}}: {route: Route}) {
  const inputs = inputsOf(query);
  const {models, response, asked, problems, settled} = useTranslation(inputs);
  const words = query.get('find') ?? '';
  const shown = found(response?.translations ?? [], words);
  const change = (changes: Record<string, string>) => {
    const kept = 'from' in changes ? Object.fromEntries(Object.entries(inputs).filter(([key]) => !key.startsWith('set.'))) : inputs;
    setQuery(queryOf({...kept, ...changes}));
  };
  const command = problems.length > 0 || wordsAmong(inputs).length > 0 ? '' : commandOf(inputs, requestOf(inputs, models));
  return (
    <>
      <div class="head"><h1>The same contact in other simulators</h1>
        <span class="actions"><a class="button" href="/docs/theory/translation.html" target="_top">How it is found</a></span></div>
      <p class="soft">The parameters with which each of them gives back the restitution that is asked for, and what it really gives back: by its own rule, under gravity, at its time step.</p>
      <Inputs inputs={inputs} models={models} problems={problems} change={change} />
      <p class="hidden" role="status" data-settled={settled}>{settled && response ? `${count(response.translations.length)} models` : ''}</p>
      {response && response.rebounds.length > 0 && <Rebounds all={response.rebounds} />}
      {response && (
        <section aria-label="In other simulators">
          <div class="tools"><h2>In other simulators</h2>
            <label>Find <input value={words} placeholder="mujoco, hertz, …" onInput={(event) => setQuery({...queryOf(inputs), find: event.currentTarget.value})} /></label>
            <LeftOut shown={shown.length} all={response.translations.length} what="models" /></div>
          <Translations all={shown} asked={asked} />
        </section>
      )}
      {command && <div class="ready"><code>{command}</code> <Copy text={command} what="the command" /></div>}
    </>
  );
}
