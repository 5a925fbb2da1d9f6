// What the server says about a page while it is written.

import {create, fromJson} from '@bufbuild/protobuf';
import {useEffect, useState} from 'preact/hooks';

import {server} from '../../api/client';
import {explain, violationsOf} from '../../api/errors';
import {JobSchema, type Estimate, type Job} from '../../api/generated/contact/v1/job_pb';
import {ScenarioSchema, SweepSchema} from '../../api/generated/contact/v1/scenario_pb';
import {templates} from '../../api/templates';
import {allProblems, readPage, type Page, type Problem} from '../../model/scenario_text';

export interface Verdict {
  page: Page;
  problems: Problem[];
  warnings: string[];
  estimate: Estimate | undefined;
  /** False while the newest page is not checked yet. */
  settled: boolean;
}

const PAUSE_MS = 250;

/** The job of a page, or what is wrong with it. */
export function jobOf(page: Page, labels: Record<string, string> = {}): Job {
  const value = page.kind === 'sweep'
    ? {case: 'sweep' as const, value: fromJson(SweepSchema, page.json!)}
    : {case: 'scenario' as const, value: fromJson(ScenarioSchema, page.json!)};
  return create(JobSchema, {spec: value, labels});
}

/** Errors of the server at their lines. */
export function problemsOf(error: unknown, page: Page): Problem[] {
  const violations = violationsOf(error);
  if (violations.length === 0) return [{line: 0, path: '', text: explain(error)}];
  return violations.map(({field, description}) => ({line: page.lineOf(field), path: field, text: description}));
}

/** Reads a page and asks the server about it: about the rest of it, if a part is wrong. */
export function useValidation(text: string): Verdict {
  const [verdict, setVerdict] = useState<Verdict>(() => ({
    page: readPage(text, templates), problems: [], warnings: [], estimate: undefined, settled: false}));
  useEffect(() => {
    const page = readPage(text, templates);
    const wrong = page.problems.length > 0;
    const control = new AbortController();
    const settle = (rest: Partial<Verdict>) => {
      if (!control.signal.aborted) setVerdict({page, problems: page.problems, warnings: [], estimate: undefined, settled: true, ...rest});
    };
    setVerdict((last) => ({...last, page, settled: false, ...(wrong ? {problems: page.problems} : {})}));
    if (page.json === undefined) { settle({}); return undefined; }
    const timer = setTimeout(() => {
      let job: Job;
      try { job = jobOf(page); } catch (error) { settle(wrong ? {} : {problems: [{line: 0, path: '', text: (error as Error).message}]}); return; }
      server.createJob({job, validateOnly: true}, {signal: control.signal}).then(
        ({warnings, estimate}) => settle(wrong ? {} : {warnings, estimate}),
        (error: unknown) => settle({problems: allProblems(page, problemsOf(error, page))}));
    }, PAUSE_MS);
    return () => { clearTimeout(timer); control.abort(); };
  }, [text]);
  return verdict;
}
