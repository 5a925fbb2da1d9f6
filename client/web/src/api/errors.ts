// What went wrong with a call, for people.

import {Code, ConnectError} from '@connectrpc/connect';

import {BadRequestSchema} from './generated/google/rpc/error_details_pb';

/** A field of a request that breaks a rule. */
export interface Violation {
  /** Path in the scenario or sweep, such as `bodies[0].mass_kg`. */
  field: string;
  /** Its value, the rule and a hint. */
  description: string;
}

/** The violations that an error carries, with paths as scenario files have them. */
export function violationsOf(error: unknown): Violation[] {
  return ConnectError.from(error).findDetails(BadRequestSchema).flatMap((detail) =>
    detail.fieldViolations.map(({field, description}) => ({
      field: field.replace(/^(job\.)?(scenario|sweep)(\.|$)/, ''),
      description,
    })));
}

/** True for errors that pass when one tries again. */
export function passes(error: unknown): boolean {
  const {code} = ConnectError.from(error);
  return code === Code.Unavailable || code === Code.Unknown || code === Code.Internal
    || code === Code.DeadlineExceeded || code === Code.ResourceExhausted || code === Code.Aborted
    || code === Code.Canceled;
}

/** One line about an error. */
export function explain(error: unknown): string {
  const {code, rawMessage} = ConnectError.from(error);
  if (code === Code.Unknown && /fetch|network/i.test(rawMessage)) {
    return 'The server does not answer.';
  }
  if (code === Code.Unauthenticated) return 'The server asks who calls: it wants a token.';
  return rawMessage || Code[code];
}
