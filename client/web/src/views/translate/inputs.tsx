// The contact that is to be translated, as it is written.

import type {ContactModel} from '../../api/generated/contact/v1/model_service_pb';
import {SETUP, WANTED, type Input} from '../../model/translation';
import type {Problem} from './use_translation';

interface Props {
  inputs: Record<string, string>;
  models: readonly ContactModel[];
  problems: readonly Problem[];
  change: (changes: Record<string, string>) => void;
}

function NumberInput({field: {key, label, unit, hint}, inputs, problems, change, off = false}: Props & {field: Input; off?: boolean}) {
  const wrong = problems.filter((problem) => problem.key === key);
  return (
    <label class="asked"><span>{label}{unit && unit !== '1' && <span class="soft"> [{unit}]</span>}</span>
      <input value={inputs[key] ?? ''} inputMode={key === 'v' ? 'text' : 'decimal'} autocomplete="off" spellcheck={false} disabled={off}
        aria-invalid={wrong.length > 0} aria-describedby={`about-${key}`} onInput={(event) => change({[key]: event.currentTarget.value})} />
      <span id={`about-${key}`} class={wrong.length > 0 ? 'bad' : 'soft'}>{wrong.length > 0 ? wrong.map(({text}) => text).join('; ') : hint}</span>
    </label>
  );
}

/** What is given: the restitution and stiffness that are wanted, or a model with its parameters. */
function GivenBy({inputs, models, change}: Props) {
  return (
    <label>The contact is given by <select value={inputs.from ?? ''} onChange={(event) => change({from: event.currentTarget.value})}>
      <option value="">restitution and stiffness</option>
      <optgroup label="parameters of">{models.map(({name, title}) => <option key={name} value={name}>{title}</option>)}</optgroup>
    </select></label>
  );
}

export function Inputs(props: Props) {
  const {inputs, models, problems} = props;
  const from = models.find(({name}) => name === inputs.from);
  const parameters = from?.parameters.map(({name, unit}): Input => ({key: `set.${name}`, label: name, unit, hint: ''})) ?? [];
  const contact = inputs.from ? parameters : WANTED;
  const shown = [...contact, ...SETUP].map(({key}) => key);
  const others = problems.filter(({key}) => !shown.includes(key));
  return (
    <form aria-label="Contact" onSubmit={(event) => event.preventDefault()}>
      <div class="tools"><GivenBy {...props} /></div>
      <fieldset class="inputs"><legend>{inputs.from ? from?.title ?? inputs.from : 'What it gives back'}</legend>
        {contact.map((field) => <NumberInput key={field.key} {...props} field={field} />)}</fieldset>
      <fieldset class="inputs"><legend>How the bodies meet</legend>
        {SETUP.map((field) => <NumberInput key={field.key} {...props} off={field.key === 'g' && Boolean(inputs.m2)}
          field={field.key === 'v' && inputs.from ? {...field, hint: 'several: 0.1, 1, 5'} : field} />)}</fieldset>
      {others.map(({key, text}, i) => <p key={i} class="notice" role="alert">{key && <code>{key}</code>} {text}</p>)}
    </form>
  );
}
