#pragma once

#include <grpcpp/grpcpp.h>

#include "base/executor.h"
#include "contact/v1/model_service.grpc.pb.h"
#include "rpc/call_starter.h"

namespace contact {

/// The calls of the contract's ModelService. Handlers never wait.
class ModelService final : public v1::ModelService::CallbackService {
 public:
  /// `calls` outlives the service.
  explicit ModelService(CallStarter& calls) : calls_(calls) {}

 private:
  using Context = grpc::CallbackServerContext;
  using Unary = grpc::ServerUnaryReactor;

  /// Answered at once.
  Unary* ListModels(Context* context, const v1::ListModelsRequest* request,
                    v1::ListModelsResponse* response) override;
  /// Answered on the thread of the service: a request takes from a millisecond to some seconds.
  Unary* TranslateModel(Context* context, const v1::TranslateModelRequest* request,
                        v1::TranslateModelResponse* response) override;

  CallStarter& calls_;
  Executor executor_{"translator"};
};

}  // namespace contact
