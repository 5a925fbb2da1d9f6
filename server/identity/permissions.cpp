#include "identity/permissions.h"

#include <algorithm>
#include <array>

namespace contact {
namespace {

constexpr std::array kMethods = std::to_array<MethodRule>({
    {"/contact.v1.JobService/CreateJob", Permission::kSubmit, true},
    {"/contact.v1.JobService/GetJob", Permission::kRead, false},
    {"/contact.v1.JobService/ListJobs", Permission::kRead, false},
    // Of the jobs of others: Permission::kChangeAny.
    {"/contact.v1.JobService/CancelJob", Permission::kSubmit, true},
    {"/contact.v1.JobService/UpdateJob", Permission::kSubmit, true},
    {"/contact.v1.JobService/DeleteJob", Permission::kSubmit, true},
    {"/contact.v1.JobService/WatchJob", Permission::kRead, false},
    {"/contact.v1.JobService/WatchJobs", Permission::kRead, false},
    {"/contact.v1.JobService/ReadArtifact", Permission::kRead, false},
    {"/contact.v1.JobService/GetSeries", Permission::kRead, false},
    {"/contact.v1.JobService/GetServerInfo", Permission::kRead, false},
    {"/contact.v1.ModelService/ListModels", Permission::kRead, false},
    {"/contact.v1.ModelService/TranslateModel", Permission::kRead, false},
    {"/contact.v1.AdminService/Backup", Permission::kServer, true},
});

}  // namespace

std::span<const MethodRule> MethodRules() { return kMethods; }

const MethodRule* FindMethod(std::string_view method) {
  const auto found = std::ranges::find(kMethods, method, &MethodRule::method);
  return found == kMethods.end() ? nullptr : &*found;
}

}  // namespace contact
