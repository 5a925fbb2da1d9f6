// The passes of an episode in numbers.

import {useMemo} from 'preact/hooks';

import type {Iteration} from '../../api/generated/contact/v1/event_pb';
import {bracketOf, nextOf, passesOf, type Pass} from '../../model/iterations';
import {exact} from '../../model/numbers';
import {typeset} from '../../model/units';
import {setQuery} from '../../ui/route';
import {leafOf, Leaves} from './leaves';

const numbersOf = (unit: string): [string, (pass: Pass) => string][] => [
  [`μ [${typeset(unit)}]`, ({unknown}) => exact(unknown.mu)],
  ['ε out', ({unknown}) => exact(unknown.restitutionOut)],
  ['residual', ({unknown}) => exact(unknown.residual)],
];

function Row({pass, numbers}: {pass: Pass; numbers: ReturnType<typeof numbersOf>}) {
  const {episode, number, unknown} = pass;
  return (
    <tr>
      <td class="number">{episode}</td><td class="number">{number}</td><td>{unknown.contact} #{unknown.number}</td>
      {numbers.map(([name, of]) => <td key={name} class="number">{of(pass)}</td>)}
      <td>{nextOf(pass)}</td><td class="number">{bracketOf(pass)}</td>
    </tr>
  );
}

function Table({rows, query, unit}: {rows: Pass[]; query: URLSearchParams; unit: string}) {
  const numbers = numbersOf(unit);
  const leaf = leafOf(rows, query.get('passes'));
  return (
    <>
      <div class="tools"><Leaves leaf={leaf} name="passes" what="passes" /></div>
      <div class="scroll tall" tabIndex={0} role="region" aria-label="Passes"><table>
        <thead><tr><th class="number">episode</th><th class="number">pass</th><th>contact, first cycle</th>
          {numbers.map(([name]) => <th key={name} class="number">{name}</th>)}<th>next</th><th class="number">bracket of μ</th></tr></thead>
        <tbody>{leaf.shown.map((pass, i) => <Row key={leaf.first + i} pass={pass} numbers={numbers} />)}</tbody>
      </table></div>
    </>
  );
}

/** The table behind the plots; it is open if the address has a page of it. */
export function Passes({iterations, episode, version, query, unit}: {
  iterations: Iteration[]; episode: number; version: number; query: URLSearchParams; unit: string;
}) {
  const open = query.has('passes');
  const rows = useMemo(() => (open ? passesOf(iterations, episode) : []), [open, version, episode]);
  return (
    <details class="passes" open={open} onToggle={(e) => {
      if (e.currentTarget.open !== open) setQuery({passes: e.currentTarget.open ? '1' : undefined});
    }}>
      <summary>Passes in numbers</summary>
      {open && <Table rows={rows} query={query} unit={unit} />}
    </details>
  );
}
