#include "cli/link/printable_answers.h"

#include <google/protobuf/any.pb.h>

#include <string>

#include "base/spelling.h"
#include "google/rpc/status.pb.h"

namespace contact::cli {
namespace {

namespace pb = google::protobuf;
using grpc::experimental::InterceptionHookPoints;

// The message that an Any holds, if its type is known, is made printable in its place.
void MakeContentPrintable(pb::Any* any) {
  const std::string& url = any->type_url();
  const auto* type =
      pb::DescriptorPool::generated_pool()->FindMessageTypeByName(url.substr(url.rfind('/') + 1));
  if (type == nullptr) return;
  const std::unique_ptr<pb::Message> message(
      pb::MessageFactory::generated_factory()->GetPrototype(type)->New());
  if (!message->ParseFromString(any->value())) return any->clear_value();
  MakePrintable(message.get());
  any->set_value(message->SerializeAsString());
}

void MakeTextPrintable(pb::Message* message, const pb::FieldDescriptor* field) {
  const pb::Reflection& fields = *message->GetReflection();
  if (!field->is_repeated()) {
    fields.SetString(message, field, PrintableLines(fields.GetString(*message, field)));
    return;
  }
  for (int i = 0; i < fields.FieldSize(*message, field); ++i) {
    fields.SetRepeatedString(message, field, i,
                             PrintableLines(fields.GetRepeatedString(*message, field, i)));
  }
}

void MakePartsPrintable(pb::Message* message, const pb::FieldDescriptor* field) {
  const pb::Reflection& fields = *message->GetReflection();
  if (!field->is_repeated()) return MakePrintable(fields.MutableMessage(message, field));
  for (int i = 0; i < fields.FieldSize(*message, field); ++i) {
    MakePrintable(fields.MutableRepeatedMessage(message, field, i));
  }
}

void MakeStatusPrintable(grpc::Status* status) {
  google::rpc::Status details;
  if (!details.ParseFromString(status->error_details())) details.Clear();
  MakePrintable(&details);
  *status = {status->error_code(), PrintableLines(status->error_message()),
             details.SerializeAsString()};
}

class Interceptor final : public grpc::experimental::Interceptor {
 public:
  void Intercept(grpc::experimental::InterceptorBatchMethods* methods) override {
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::POST_RECV_MESSAGE)) {
      auto* message = static_cast<pb::Message*>(methods->GetRecvMessage());
      if (message != nullptr) MakePrintable(message);
    }
    if (methods->QueryInterceptionHookPoint(InterceptionHookPoints::POST_RECV_STATUS)) {
      grpc::Status* status = methods->GetRecvStatus();
      if (!status->ok()) MakeStatusPrintable(status);
    }
    methods->Proceed();
  }
};

class Factory final : public grpc::experimental::ClientInterceptorFactoryInterface {
 public:
  grpc::experimental::Interceptor* CreateClientInterceptor(
      grpc::experimental::ClientRpcInfo* /*call*/) override {
    return new Interceptor();
  }
};

}  // namespace

void MakePrintable(pb::Message* message) {
  if (auto* any = dynamic_cast<pb::Any*>(message)) return MakeContentPrintable(any);
  std::vector<const pb::FieldDescriptor*> set;
  message->GetReflection()->ListFields(*message, &set);
  for (const pb::FieldDescriptor* field : set) {
    if (field->type() == pb::FieldDescriptor::TYPE_STRING) MakeTextPrintable(message, field);
    if (field->type() == pb::FieldDescriptor::TYPE_MESSAGE) MakePartsPrintable(message, field);
  }
}

Interceptors PrintableAnswers() {
  Interceptors all;
  all.push_back(std::make_unique<Factory>());
  return all;
}

}  // namespace contact::cli
