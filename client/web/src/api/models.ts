// Calls about contact models of other simulators.

import {createClient} from '@connectrpc/connect';

import {transport} from './client';
import {ModelService} from './generated/contact/v1/model_service_pb';

export const models = createClient(ModelService, transport);
