#pragma once

#include <vector>

#include "contact/v1/model_service.pb.h"
#include "translate/translation.h"
#include "wire/rules/violation.h"

namespace contact {

/// A request of TranslateModel as values, and what is wrong with it.
struct DecodedTranslation {
  /// The contact by what it gives back; empty where `from` is given.
  translate::Wanted wanted = {};
  /// The model whose parameters describe the contact; null if none do.
  const translate::Tool* from = nullptr;
  /// The values of its parameters, in their order.
  std::vector<double> values = {};
  /// One for each velocity; at least one.
  std::vector<translate::Setup> setups = {};
  /// The models to translate to.
  std::vector<const translate::Tool*> targets = {};
  /// All rules broken. With any, the other members are incomplete.
  std::vector<Violation> violations = {};
};

/// Reads the request and checks the rules of model_service.proto.
DecodedTranslation DecodeTranslation(const v1::TranslateModelRequest& request);

/// The message of a translation at this approach velocity [m/s].
v1::ModelTranslation EncodeTranslation(const translate::Translation& found, double velocity);

/// All models.
v1::ListModelsResponse EncodeModels();

}  // namespace contact
