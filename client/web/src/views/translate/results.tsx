// What models of other simulators want for a contact, and what each of them really delivers.

import type {ModelTranslation} from '../../api/generated/contact/v1/model_service_pb';
import {compact, exact, short} from '../../model/numbers';
import {differenceOf, reboundOf} from '../../model/translation';
import {Copy} from '../../ui/copy';

const DIGITS = 8;
const ratio = (value: number | undefined) => (value === undefined || Number.isNaN(value) ? '–' : value.toFixed(5));

function Parameters({found}: {found: ModelTranslation}) {
  if (found.parameters.length === 0) return <span class="soft">none</span>;
  return <ul class="parameters">{found.parameters.map(({name, value, unit}) => (
    <li key={name}><span class="mono">{name}</span> <span class="number" title={exact(value)}>{compact(value, DIGITS)}</span> {unit !== '1' && <span class="soft">{unit}</span>}</li>))}</ul>;
}

/** A ratio, and how far it is from the one asked for. */
function Delivered({value, asked}: {value: number; asked: number}) {
  const difference = differenceOf(value, asked);
  const far = Math.abs(value - asked) >= 0.005;
  return <td class="number" title={exact(value)}>{ratio(value)} <span class={far ? 'differs' : 'soft'}>{difference}</span></td>;
}

function Model({found, asked}: {found: ModelTranslation; asked: number}) {
  const {model, title, source, delivered, atStep, line, warnings, textbookRestitution} = found;
  return (
    <tbody data-model={model}>
      <tr>
        <th scope="row" title={source}>{title}<br /><span class="soft mono">{model}</span></th>
        <td><Parameters found={found} /></td>
        <Delivered value={delivered?.restitutionAlone ?? NaN} asked={asked} />
        <Delivered value={reboundOf(found)} asked={asked} />
        <td class="number">{atStep && atStep.most - atStep.least > 1e-5 ? `${ratio(atStep.least)} to ${ratio(atStep.most)}` : ''}</td>
        <td class="number">{ratio(textbookRestitution)}</td>
      </tr>
      <tr class="more"><td colSpan={6}>
        {line && <div class="ready"><code>{line}</code> <Copy text={line} what={`the line for ${title}`} /></div>}
        {warnings.length > 0 && <ul class="warnings">{warnings.map((text) => <li key={text}><span aria-hidden="true">⚠</span> {text}</li>)}</ul>}
      </td></tr>
    </tbody>
  );
}

export function Translations({all, asked}: {all: readonly ModelTranslation[]; asked: number}) {
  return (
    <div class="scroll whole" tabIndex={0} role="region" aria-label="Parameters of other simulators"><table class="translations">
      <thead><tr><th scope="col">simulator</th><th scope="col">parameters</th><th scope="col" class="number">ε, and difference</th>
        <th scope="col" class="number">rebound, and difference</th><th scope="col" class="number">as the touch falls in a step</th><th scope="col" class="number">textbook ε</th></tr></thead>
      {all.map((found) => <Model key={found.model} found={found} asked={asked} />)}
    </table></div>
  );
}

/** What the model that is given delivers at each velocity. */
export function Rebounds({all}: {all: readonly ModelTranslation[]}) {
  const notes = all[0]?.warnings ?? [];
  return (
    <section aria-label="What it gives back"><h2>What it gives back</h2>
      <div class="scroll" tabIndex={0} role="region" aria-label="What it gives back at each velocity"><table>
        <thead><tr>{['v [m/s]', 'ε', 'rebound', 'contact time [s]', 'deformation [m]', 'peak force [N]'].map((name) => <th key={name} scope="col" class="number">{name}</th>)}</tr></thead>
        <tbody>{all.map((found, i) => <tr key={i}><td class="number">{short(found.velocityMPerS, 6)}</td><td class="number">{ratio(found.delivered?.restitution)}</td><td class="number">{ratio(reboundOf(found))}</td>
          {[found.delivered?.contactTimeS, found.delivered?.deformationM, found.delivered?.peakForceN].map((value, k) => <td key={k} class="number" title={exact(value)}>{value === undefined ? '' : compact(value, 5)}</td>)}</tr>)}</tbody>
      </table></div>
      {notes.length > 0 && <ul class="warnings">{notes.map((text) => <li key={text}><span aria-hidden="true">⚠</span> {text}</li>)}</ul>}
    </section>
  );
}
