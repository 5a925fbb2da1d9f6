// What can go wrong with a call, with all that the server says of it.

import grpc from '@grpc/grpc-js';

import type {Messages, Violation} from './checked.js';

/** A call that the server, the way to it, or the client refused. */
export class ContactError extends Error {
  /**
   * @param code of gRPC
   * @param reason ErrorInfo.reason, such as `JOB_NOT_FOUND`; may be empty
   * @param violations every field that is not as it must be
   * @param metadata of ErrorInfo
   */
  constructor(readonly details: string, readonly code: grpc.status, readonly reason = '',
              readonly violations: Violation[] = [],
              readonly metadata: Record<string, string> = {}) {
    super([details, ...violations.map(inWords)].join('\n'));
    this.name = 'ContactError';
  }
}

function inWords({field, description, hint}: Violation): string {
  return `  ${field}: ${description}${hint ? ` — ${hint}` : ''}`;
}

/** Of a field of a request; the server appends the hint, and sends paths from the job. */
function violationOf(sent: {field: string; description: string}): Violation {
  const [description = '', ...hint] = sent.description.split(' — ');
  return {field: sent.field.replace(/^(job\.)?(scenario\.)?/, ''), description, hint: hint.join(' — ')};
}

/** The error with what its trailers tell. */
export function fromService(error: grpc.ServiceError, messages: Messages): ContactError {
  let reason = '';
  let metadata = {};
  let violations: Violation[] = [];
  for (const bytes of error.metadata?.get('grpc-status-details-bin') ?? []) {
    for (const detail of messages.decode('google.rpc.Status', bytes as Buffer).details) {
      const type = String(detail.type_url).split('/').pop();
      if (type !== 'google.rpc.ErrorInfo' && type !== 'google.rpc.BadRequest') continue;
      const told = messages.decode(type, detail.value);
      if (type === 'google.rpc.ErrorInfo') ({reason, metadata} = told as any);
      else violations = told.field_violations.map(violationOf);
    }
  }
  return new ContactError(error.details, error.code, reason, violations, metadata);
}

/** Refuses what the contract has not. */
export function require(messages: Messages, type: string, value: unknown, what: string): void {
  const violations = messages.violations(type, value).map((each) =>
    ({...each, field: each.field.replace(/^job\./, '')}));
  if (violations.length === 0) return;
  throw new ContactError(`the ${what} is invalid`, grpc.status.INVALID_ARGUMENT,
                         'FIELD_INVALID', violations);
}

/** What went wrong, in lines with what to do about it. */
export function explain(error: unknown, address: string): string {
  const {code, details} = error as Partial<grpc.ServiceError>;
  if (code === grpc.status.UNAVAILABLE) {
    return `cannot reach contactd at ${address}; start one with contactctl dev, `
      + 'or give its HOST:PORT';
  }
  if (code === undefined) return String(error);
  const words = error instanceof ContactError ? error.message : details ?? '';
  return `${grpc.status[code]}: ${words}`;
}
