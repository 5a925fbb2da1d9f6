#include "rpc/model_service.h"

#include <utility>
#include <vector>

#include "jobs/job/errors.h"
#include "wire/translation_codec.h"

namespace contact {
namespace {

using Response = v1::TranslateModelResponse;

Error NothingComesBack() {
  return Invalid({{"from.values", "let no body part: there is nothing to translate", ""}});
}

// What the model of `from` gives back at each velocity; what is to be translated goes into
// `wanted`.
void AddRebounds(const DecodedTranslation& decoded, const Abandoned& abandoned, Response* response,
                 translate::Wanted* wanted) {
  for (const translate::Setup& setup : decoded.setups) {
    if (abandoned()) return;
    const translate::Translation found = Judge(*decoded.from, decoded.values, setup);
    if (response->rebounds().empty()) *wanted = WantedOf(found);
    *response->add_rebounds() = EncodeTranslation(found, setup.collision.velocity);
  }
}

// Looks before each model whether somebody still waits.
Result<Response> Answer(const v1::TranslateModelRequest& request, const Abandoned& abandoned) {
  DecodedTranslation decoded = DecodeTranslation(request);
  if (!decoded.violations.empty()) return Invalid(std::move(decoded.violations));
  Response response;
  translate::Wanted wanted = decoded.wanted;
  if (decoded.from != nullptr) AddRebounds(decoded, abandoned, &response, &wanted);
  if (abandoned()) return MakeError(Reason::kDeadlineExceeded);
  const translate::Setup& setup = decoded.setups.front();
  if (!decoded.targets.empty() && !(wanted.restitution > 0)) return NothingComesBack();
  for (const translate::Tool* tool : decoded.targets) {
    if (abandoned()) return MakeError(Reason::kDeadlineExceeded);
    *response.add_translations() =
        EncodeTranslation(Translate(*tool, wanted, setup), setup.collision.velocity);
  }
  return response;
}

}  // namespace

ModelService::Unary* ModelService::ListModels(Context* context,
                                              const v1::ListModelsRequest* /*request*/,
                                              v1::ListModelsResponse* response) {
  const Call call{"/contact.v1.ModelService/ListModels"};
  return calls_.Unary<v1::ListModelsResponse>(
      context, call, response, [](const auto& /*caller*/, auto answer) { answer(EncodeModels()); });
}

ModelService::Unary* ModelService::TranslateModel(Context* context,
                                                  const v1::TranslateModelRequest* request,
                                                  Response* response) {
  const Call call{"/contact.v1.ModelService/TranslateModel"};
  return calls_.Unary<Response>(context, call, response, [&](const auto& /*caller*/, auto answer) {
    const Abandoned abandoned = Abandonment(*context);
    const bool posted =
        executor_.Post([request, abandoned, answer] { answer(Answer(*request, abandoned)); });
    if (!posted) answer(MakeError(Reason::kServerDraining));
  });
}

}  // namespace contact
