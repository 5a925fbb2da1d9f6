// Plots of formulas, which stand in the address.

import {useState} from 'preact/hooks';

import {columnsOf, formulaOf} from '../../model/derived';
import type {Mechanics} from '../../model/mechanics';
import {setQuery} from '../../ui/route';

/** Adds a formula and takes it away; tells what is wrong with it. */
export function Derived({mechanics, shown}: {mechanics: Mechanics; shown: string[]}) {
  const [text, setText] = useState('');
  const [wrong, setWrong] = useState('');
  const add = (event: Event) => {
    event.preventDefault();
    try {
      formulaOf(text, columnsOf(mechanics));
      setQuery({derived: [...new Set([...shown, text.trim()])]});
      setText('');
      setWrong('');
    } catch (error) { setWrong((error as Error).message); }
  };
  return (
    <form class="group" aria-label="Derived plots" onSubmit={add}>
      <label>Formula <input value={text} spellcheck={false} placeholder={`abs(${mechanics.bodies[0]?.name ?? 'ball'}.velocity)`} onInput={(e) => setText(e.currentTarget.value)} /></label>
      <button type="submit" disabled={text.trim() === ''}>Plot it</button>
      {shown.map((one) => <button key={one} type="button" class="quiet" aria-label={`remove ${one}`} onClick={() => setQuery({derived: shown.filter((other) => other !== one)})}>{one} ✕</button>)}
      {wrong && <span class="bad" role="alert">{wrong}</span>}
    </form>
  );
}
