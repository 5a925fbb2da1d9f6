// The typed client of contactd, over Connect with binary messages, to the origin of the page.

import {Code, ConnectError, createClient, type Interceptor} from '@connectrpc/connect';
import {createConnectTransport} from '@connectrpc/connect-web';

import {JobService} from './generated/contact/v1/job_service_pb';
import {token, wantToken} from './token';

/** Passes an error on, and asks for a token if that is what is wanting. */
function refused(error: unknown): never {
  if (ConnectError.from(error).code === Code.Unauthenticated) wantToken();
  throw error;
}

/** The messages of a stream, whose refusal comes at its end. */
async function* heard<T>(messages: AsyncIterable<T>): AsyncGenerator<T> {
  try {
    yield* messages;
  } catch (error) {
    refused(error);
  }
}

const identity: Interceptor = (next) => async (request) => {
  if (token()) request.header.set('authorization', `Bearer ${token()}`);
  const answer = await next(request).catch(refused);
  return answer.stream ? {...answer, message: heard(answer.message)} : answer;
};

/** The way to the server that served this page. */
export const transport = createConnectTransport({
  baseUrl: globalThis.location?.origin ?? 'http://127.0.0.1',
  useBinaryFormat: true,
  interceptors: [identity],
});

/** Its calls about jobs. */
export const server = createClient(JobService, transport);
