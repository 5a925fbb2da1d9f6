// The typed client of contactd, over Connect with binary messages, to the origin of the page.

import {Code, ConnectError, createClient, type Interceptor} from '@connectrpc/connect';
import {createConnectTransport} from '@connectrpc/connect-web';

import {JobService} from './generated/contact/v1/job_service_pb';
import {token, wantToken} from './token';

const identity: Interceptor = (next) => async (request) => {
  if (token()) request.header.set('authorization', `Bearer ${token()}`);
  try {
    return await next(request);
  } catch (error) {
    if (ConnectError.from(error).code === Code.Unauthenticated) wantToken();
    throw error;
  }
};

/** Calls of the server that served this page. */
export const server = createClient(JobService, createConnectTransport({
  baseUrl: globalThis.location?.origin ?? 'http://127.0.0.1',
  useBinaryFormat: true,
  interceptors: [identity],
}));
