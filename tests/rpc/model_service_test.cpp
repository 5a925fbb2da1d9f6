// The calls of ModelService, through a whole server.
#include <gmock/gmock.h>

#include <string>

#include "contact/v1/model_service.grpc.pb.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "test_server.h"

namespace contact {
namespace {

v1::TranslateModelRequest Request() {
  v1::TranslateModelRequest request;
  request.set_mass_kg(1);
  request.add_velocities_m_per_s(1);
  request.set_radius_m(0.02);
  request.set_step_s(1e-5);
  return request;
}

// A server, and its models.
class ModelServiceTest : public testing::Test {
 protected:
  grpc::Status Translate(const v1::TranslateModelRequest& request) {
    grpc::ClientContext context;
    return stub_->TranslateModel(&context, request, &response_);
  }

  TestServer server_;
  const std::unique_ptr<v1::ModelService::Stub> stub_ =
      v1::ModelService::NewStub(server_.Connect());
  v1::TranslateModelResponse response_;
};

TEST_F(ModelServiceTest, EveryModelThatIsListedIsTranslatedTo) {
  grpc::ClientContext context;
  v1::ListModelsResponse list;
  ASSERT_TRUE(stub_->ListModels(&context, {}, &list).ok());
  v1::TranslateModelRequest request = Request();
  request.mutable_wanted()->set_restitution(0.7);
  request.mutable_wanted()->set_contact_time_s(0.005);
  ASSERT_TRUE(Translate(request).ok());
  ASSERT_EQ(response_.translations_size(), list.models_size());
  for (int i = 0; i < list.models_size(); ++i) {
    EXPECT_EQ(response_.translations(i).model(), list.models(i).name());
    EXPECT_NEAR(response_.translations(i).delivered().restitution_alone(), 0.7, 1e-6);
  }
}

TEST_F(ModelServiceTest, AModelsOwnParametersComeBackThroughAnother) {
  v1::TranslateModelRequest request = Request();
  request.add_velocities_m_per_s(2);
  request.add_models("simscape-damped");
  request.mutable_from()->set_model("lammps-hooke");
  (*request.mutable_from()->mutable_values())["kn"] = 1e5;
  (*request.mutable_from()->mutable_values())["eta"] = 50;
  ASSERT_TRUE(Translate(request).ok());
  ASSERT_EQ(response_.rebounds_size(), 2);
  EXPECT_EQ(response_.rebounds(1).velocity_m_per_s(), 2);
  EXPECT_NEAR(response_.rebounds(0).delivered().restitution_alone(),
              response_.rebounds(1).delivered().restitution_alone(), 1e-6)
      << "ε of a linear law does not depend on the speed";
  ASSERT_EQ(response_.translations_size(), 1);
  EXPECT_NEAR(response_.translations(0).parameters(0).value(), 1e5, 1) << "the same law";
  EXPECT_NEAR(response_.translations(0).parameters(1).value(), 50, 1e-3);
}

TEST_F(ModelServiceTest, AllViolationsAreInTheAnswer) {
  v1::TranslateModelRequest request = Request();
  request.set_mass_kg(-1);
  request.mutable_wanted()->set_restitution(2);
  request.mutable_wanted()->set_stiffness(1);
  const grpc::Status status = Translate(request);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(Reason(status), "FIELD_INVALID");
  EXPECT_THAT(status.error_message(), testing::HasSubstr("mass_kg"));
}

TEST_F(ModelServiceTest, WhatNeverComesBackIsNotTranslated) {
  v1::TranslateModelRequest request = Request();
  request.add_models("drake");
  request.mutable_from()->set_model("lammps-hooke");
  (*request.mutable_from()->mutable_values())["kn"] = 1;
  (*request.mutable_from()->mutable_values())["eta"] = 50;
  EXPECT_THAT(Translate(request).error_message(), testing::HasSubstr("let no body part"));
}

}  // namespace
}  // namespace contact
