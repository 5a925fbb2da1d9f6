// The scenario as it is written: bodies, walls and supports to scale, velocities as arrows.

import {useLayoutEffect, useMemo, useRef} from 'preact/hooks';

import type {Scenario} from '../../api/generated/contact/v1/scenario_pb';
import {hitAt} from '../../model/form/hit';
import {mechanicsOf} from '../../model/mechanics';
import {short} from '../../model/numbers';
import {atStart, firstBodies} from '../../model/stage';
import {drawStrip, scaleOf, sheetOf, STRIP_PX} from '../../plots/strip';
import {LeftOut} from '../../ui/left_out';
import {useTheme} from '../../ui/theme';
import {useWidth} from '../../ui/use_width';
import {jobOf, type Verdict} from './use_validation';

/** The scenario of a page, of a sweep its base, if all of it is right. */
function scenarioOf({page, problems, settled}: Verdict): Scenario | undefined {
  if (!settled || problems.length > 0 || !page.json) return undefined;
  const {spec} = jobOf(page);
  return spec.case === 'sweep' ? spec.value.base : spec.case === 'scenario' ? spec.value : undefined;
}

/** The newest scenario that was right. */
function useRight(verdict: Verdict): Scenario | undefined {
  const last = useRef<Scenario>();
  const now = useMemo(() => scenarioOf(verdict), [verdict]);
  if (now) last.current = now;
  return last.current;
}

/** `choose` is told of the body or contact that is clicked on. */
export function Picture({verdict, choose}: {verdict: Verdict; choose: (list: 'bodies' | 'contacts', name: string) => void}) {
  const theme = useTheme();
  const scenario = useRight(verdict);
  const [box, width] = useWidth(600);
  const canvas = useRef<HTMLCanvasElement>(null);
  const mechanics = useMemo(() => (scenario ? mechanicsOf(scenario) : undefined), [scenario]);
  const stage = useMemo(() => (mechanics ? atStart(firstBodies(mechanics)) : undefined), [mechanics]);
  const stale = verdict.problems.length > 0;
  useLayoutEffect(() => {
    if (stage && canvas.current && width > 0) drawStrip(stage, sheetOf(canvas.current, width, theme), 0);
  }, [stage, width, theme]);
  const words = stage?.mechanics.bodies.map(({name, position}, i) => `${name} at ${short(position)} m${stage.velocities![i] ? `, ${short(stage.velocities![i]!)} m/s` : ''}`).join('; ');
  const point = (event: MouseEvent) => {
    const box = canvas.current!.getBoundingClientRect();
    const hit = stage && hitAt({mechanics: stage.mechanics, ...scaleOf(stage, box.width)}, event.clientX - box.left);
    if (hit) choose(hit.list, hit.name);
  };
  return (
    <section class="strip" aria-label="The scenario as it begins" hidden={!stage} data-stale={stale}>
      <div ref={box}><canvas ref={canvas} class={stale ? 'stale' : ''} height={STRIP_PX} onClick={point} role="img" aria-label={words} /></div>
      <p class="note soft">{stale ? 'the last text that was right' : 'to scale, at the start; arrows: velocities; a click on a body or contact shows its fields'}
        {' '}<LeftOut shown={stage?.mechanics.bodies.length ?? 0} all={mechanics?.bodies.length ?? 0} what="bodies" /></p>
    </section>
  );
}
