#pragma once

#include <google/protobuf/text_format.h>

#include <stdexcept>
#include <string>

#include "contact/v1/event.pb.h"
#include "contact/v1/job.pb.h"

namespace contact::cli {

/// A message from its text format.
template <class Message>
Message FromText(const std::string& text) {
  Message message;
  if (!google::protobuf::TextFormat::ParseFromString(text, &message))
    throw std::invalid_argument(text);
  return message;
}
inline v1::Job JobFrom(const std::string& text) { return FromText<v1::Job>(text); }
inline v1::Event EventFrom(const std::string& text) { return FromText<v1::Event>(text); }

}  // namespace contact::cli
