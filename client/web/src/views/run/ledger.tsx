// The ledger: cycles and groups, with a filter.

import {useMemo} from 'preact/hooks';

import {
  Cycle_End, Cycle_Kind, Cycle_Status, Group_Growth, type Cycle, type Group,
} from '../../api/generated/contact/v1/job_pb';
import type {RunState} from '../../model/runState';
import {count, exact} from '../../model/numbers';
import {isCut, lookOfStatus, reachedOf, restitutionOf} from '../../model/status';
import {typeset} from '../../model/units';
import {setQuery} from '../../ui/route';
import {leafOf, Leaves} from './leaves';
import {setWindow} from './window';

interface Column<T> {
  name: string;
  of: (row: T) => string;
  words?: boolean;
}

const cycleColumns = (unit: string): Column<Cycle>[] => [
  {name: 'kind', of: (c) => Cycle_Kind[c.kind], words: true},
  {name: 'end', of: (c) => Cycle_End[c.end], words: true},
  {name: 'group', of: (c) => exact(c.group)},
  {name: 'n', of: (c) => exact(c.iterations)},
  {name: 'ε in', of: (c) => exact(c.restitutionIn)},
  {name: 'ε out', of: (c) => exact(restitutionOf(c))},
  {name: `μ [${unit}]`, of: (c) => exact(c.mu)},
  {name: 'μ/k [s/m]', of: (c) => exact(c.muOverKSPerM)},
  {name: 'α', of: (c) => exact(c.alpha)},
  {name: 'peak force [N]', of: (c) => exact(c.peakForceN)},
  {name: 'δ max [m]', of: (c) => exact(c.deltaMaxM)},
  {name: 't start [s]', of: (c) => exact(c.startTimeS)},
  {name: 't turn [s]', of: (c) => exact(c.turnTimeS)},
  {name: 't end [s]', of: (c) => exact(c.endTimeS)},
  {name: 'δ̇ start [m/s]', of: (c) => exact(c.approachVelocityMPerS)},
  {name: 'δ̇ end [m/s]', of: (c) => exact(c.separationVelocityMPerS)},
  {name: 'W_c [J]', of: (c) => exact(c.workCompressionJ)},
  {name: 'W_r [J]', of: (c) => exact(c.workRestitutionJ)},
  {name: 'residual', of: (c) => exact(c.identityResidual)},
];
const groupColumns = (unit: string): Column<Group>[] => [
  {name: 'cycles', of: (g) => `${g.firstCycle}${g.cycles > 1 ? `–${g.firstCycle + g.cycles - 1}` : ''}`},
  {name: 'encounter', of: (g) => exact(g.encounter)},
  {name: 'end', of: (g) => Cycle_End[g.end], words: true},
  {name: 'grew', of: (g) => (g.growth > 1 ? Group_Growth[g.growth] : ''), words: true},
  {name: 'ε in', of: (g) => exact(g.restitutionIn)},
  {name: 'ε out', of: (g) => exact(g.restitutionOut)},
  {name: `μ [${unit}]`, of: (g) => exact(g.mu)},
  {name: 'W_c [J]', of: (g) => exact(g.workCompressionJ)},
  {name: 'W_r [J]', of: (g) => exact(g.workRestitutionJ)},
  {name: 't start [s]', of: (g) => exact(g.startTimeS)},
  {name: 't end [s]', of: (g) => exact(g.endTimeS)},
  {name: 'residual', of: (g) => exact(g.residual)},
  {name: 'reached', of: reachedOf, words: true},
  {name: 'other μ', of: (g) => g.otherRoots.map((mu) => exact(mu)).join(', ')},
];

function Status({status}: {status: Cycle_Status}) {
  const {sign, tone, meaning} = lookOfStatus(status);
  return <span class={`badge ${tone}`} title={meaning}><span aria-hidden="true">{sign}</span> {Cycle_Status[status]}</span>;
}

type Entry = (Cycle | Group) & {contact: string; number: number; status: Cycle_Status; startTimeS: number; endTimeS: number};

function zoom({startTimeS, endTimeS}: Entry): void {
  const margin = 0.1 * (endTimeS - startTimeS) || 1e-9;
  setWindow([startTimeS - margin, endTimeS + margin]);
}

/** A row; it is made once, for entries do not change. */
function Line<T extends Entry>({row, columns}: {row: T; columns: Column<T>[]}) {
  return useMemo(() => (
    <tr class={isCut(row) ? 'cut' : ''}>
      <td><button type="button" class="quiet" title="show this stretch of time" onClick={() => zoom(row)}>{row.contact}</button></td>
      <td class="number">{row.number}</td><td><Status status={row.status} /></td>
      {columns.map((column) => <td key={column.name} class={column.words ? '' : 'number'}>{column.of(row)}</td>)}
    </tr>), [row, columns]);
}

function Table<T extends Entry>({rows, columns}: {rows: T[]; columns: Column<T>[]}) {
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Ledger">
      <table>
        <thead><tr><th>contact</th><th class="number">#</th><th>status</th>{columns.map(({name, words}) => <th key={name} class={words ? '' : 'number'}>{name}</th>)}</tr></thead>
        <tbody>{rows.map((row) => <Line key={`${row.contact}#${row.number}`} row={row} columns={columns} />)}</tbody>
      </table>
    </div>
  );
}

export function Ledger({run, query, unit}: {run: RunState; query: URLSearchParams; unit: string}) {
  const columns = useMemo(() => ({cycles: cycleColumns(typeset(unit)), groups: groupColumns(typeset(unit))}), [unit]);
  const groups = query.get('ledger') === 'groups';
  const contact = query.get('contact') ?? '';
  const status = query.get('status') ?? '';
  const all: Entry[] = groups ? run.groups : run.cycles;
  const contacts = useMemo(() => [...new Set(run.cycles.map((c) => c.contact))], [run.cycles.length]);
  const rows = all.filter((row) => (!contact || row.contact === contact) && (!status || Cycle_Status[row.status] === status));
  const statuses = [...new Set(all.map((row) => Cycle_Status[row.status]!))];
  const leaf = leafOf(rows, query.get('leaf'));
  return (
    <section aria-label="Cycle ledger">
      <div class="tools"><h2>Ledger</h2>
        <label>Show <select value={groups ? 'groups' : ''} onChange={(e) => setQuery({ledger: e.currentTarget.value, leaf: undefined})}>
          <option value="">cycles</option><option value="groups">groups</option></select></label>
        <label>Contact <select value={contact} onChange={(e) => setQuery({contact: e.currentTarget.value, leaf: undefined})}>
          <option value="">all</option>{contacts.map((c) => <option key={c}>{c}</option>)}</select></label>
        <label>Status <select value={status} onChange={(e) => setQuery({status: e.currentTarget.value, leaf: undefined})}>
          <option value="">all</option>{statuses.map((s) => <option key={s}>{s}</option>)}</select></label>
        <span class="soft">{count(rows.length)} of {count(all.length)}</span>
        <Leaves leaf={leaf} name="leaf" what="the ledger" />
      </div>
      {all.length === 0 ? <p class="nothing">No {groups ? 'group' : 'cycle'} has ended yet.</p>
        : groups ? <Table rows={leaf.shown as Group[]} columns={columns.groups} /> : <Table rows={leaf.shown as Cycle[]} columns={columns.cycles} />}
    </section>
  );
}
