// One cell of a sweep, and the way from it to a run.

import {create, fromJson, toJson, type JsonObject} from '@bufbuild/protobuf';
import {useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain} from '../../api/errors';
import type {SweepCell} from '../../api/generated/contact/v1/event_pb';
import {JobSchema} from '../../api/generated/contact/v1/job_pb';
import {ScenarioSchema, type Scenario, type Sweep} from '../../api/generated/contact/v1/scenario_pb';
import {setField} from '../../model/field_path';
import {count, exact} from '../../model/numbers';
import {metricText, outcomeOf} from '../../model/sweep';
import {axisLabel, metricLabel} from '../../model/sweep_labels';
import {typeset} from '../../model/units';
import {requestId} from '../../ui/request_id';
import {go} from '../../ui/route';

/** The scenario of a cell. */
export function scenarioOf(sweep: Sweep, values: number[]): Scenario {
  const json = toJson(ScenarioSchema, sweep.base!, {useProtoFieldName: true}) as JsonObject;
  sweep.axes.forEach(({field, also}, i) => {
    for (const path of [field, ...also]) setField(json, path, values[i]);
  });
  return fromJson(ScenarioSchema, json);
}

/** Runs a cell as a job of its own and goes there. */
export async function runCell(id: string, sweep: Sweep, cell: SweepCell): Promise<void> {
  const job = create(JobSchema, {
    spec: {case: 'scenario', value: scenarioOf(sweep, cell.values)}, labels: {sweep: id, cell: String(cell.index)},
  });
  const {name} = await server.createJob({job, requestId: requestId()});
  go(`/runs/${name.replace('jobs/', '')}`);
}

export function CellDetails({id, sweep, cell, index}: {id: string; sweep: Sweep; cell: SweepCell | undefined; index: number}) {
  const [error, setError] = useState('');
  if (!cell) return <p class="soft" role="status">Cell {index} is not computed yet.</p>;
  return (
    <div class="cell-details" role="status">
      <h3>Cell {index}: {outcomeOf(cell)}{cell.cycles === 0n && ', no contact'}{cell.cyclesCut > 0n && `, ${count(cell.cyclesCut)} cut by the end`}</h3>
      {cell.message && <p>{cell.stateReason}: {cell.message}</p>}
      <dl>
        {sweep.axes.map((axis, i) => <div key={axis.field}><dt>{typeset(axisLabel(sweep, i))}</dt><dd>{exact(cell.values[i]!)}</dd></div>)}
        {sweep.metrics.map((name, i) => <div key={name}><dt>{typeset(metricLabel(name))}</dt><dd>{metricText(cell, i)}</dd></div>)}
      </dl>
      <button type="button" class="primary" onClick={() => { runCell(id, sweep, cell).catch((e: unknown) => setError(explain(e))); }}>Run this cell</button>
      {error && <p role="alert">{error}</p>}
    </div>
  );
}
