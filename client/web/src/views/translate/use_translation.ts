// What the server answers about the contact of the page.

import {models as calls} from '../../api/models';
import {explain, violationsOf} from '../../api/errors';
import type {ContactModel, TranslateModelResponse} from '../../api/generated/contact/v1/model_service_pb';
import {inputAt, requestOf, wordsAmong} from '../../model/translation';
import {useAsync} from '../../ui/use_async';

/** What is wrong with an input; with the whole if `key` is empty. */
export interface Problem {
  key: string;
  text: string;
}

export interface Translated {
  models: readonly ContactModel[];
  /** Undefined while something is wrong with the inputs. */
  response: TranslateModelResponse | undefined;
  /** The restitution that `response` is about. */
  asked: number;
  problems: Problem[];
  /** False while the newest inputs are not answered yet. */
  settled: boolean;
}

const PAUSE_MS = 250;
const NONE: readonly ContactModel[] = [];

/** Waits until nothing has been written for a while. */
function rest(signal: AbortSignal): Promise<void> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(resolve, PAUSE_MS);
    signal.addEventListener('abort', () => { clearTimeout(timer); reject(new Error('something newer is there')); });
  });
}

interface Outcome {
  key: string;
  asked: number;
  response?: TranslateModelResponse;
  problems: Problem[];
}

function problemsOf(error: unknown): Problem[] {
  const violations = violationsOf(error);
  if (violations.length === 0) return [{key: '', text: explain(error)}];
  return violations.map(({field, description}) => ({key: inputAt(field), text: description}));
}

/** The models, and the answer about these inputs. */
export function useTranslation(inputs: Record<string, string>): Translated {
  const list = useAsync((signal) => calls.listModels({}, {signal}), []);
  const known = list.value?.models;
  const key = JSON.stringify([inputs, known !== undefined]);
  const words = wordsAmong(inputs);
  const asked = Number(inputs.e);
  const {value: last} = useAsync<Outcome>(async (signal) => {
    if (words.length > 0 || (inputs.from && !known)) return {key, asked, problems: []};
    await rest(signal);
    return calls.translateModel(requestOf(inputs, known ?? NONE), {signal}).then(
      (response) => ({key, asked: response.rebounds[0]?.delivered?.restitutionAlone ?? asked, response, problems: []}),
      (error: unknown) => ({key, asked, problems: problemsOf(error)}));
  }, [key]);
  const own: Problem[] = words.map((word) => ({key: word, text: 'is no number'}));
  const failed: Problem[] = list.error === undefined ? [] : [{key: '', text: explain(list.error)}];
  return {models: known ?? NONE, response: last?.response, asked: last?.asked ?? asked, problems: own.length > 0 ? own : [...failed, ...(last?.problems ?? [])],
    settled: last?.key === key || failed.length > 0};
}
