// In the place of the functions that the module has: load it, and call them there.
#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "cli/export_mat.h"
#include "cli/export_netcdf.h"
#include "cli/failure.h"
#include "cli/formats_module.h"
#include "cli/pdf_source.h"

namespace contact::cli {
namespace {

constexpr char kModule[] = "contactctl-formats.so";

// Beside contactctl, or where it was installed. Never unloaded: what it throws outlives the call.
void* Load() {
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  for (const auto& path : {folder / kModule, folder / "../lib/contactctl" / kModule}) {
    if (!std::filesystem::exists(path, error)) continue;
    if (void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return module;
    throw Failure(ExitCode::kLocal, dlerror());
  }
  throw Failure(
      ExitCode::kLocal,
      fmt::format("{}: neither in {} nor in ../lib/contactctl; netCDF, MAT and PDF need it",
                  kModule, folder.string()));
}

template <class Function>
Function* Exported(const char* name) {
  static void* const module = Load();
  if (void* function = dlsym(module, name)) return reinterpret_cast<Function*>(function);
  throw Failure(ExitCode::kLocal, dlerror());
}

}  // namespace

void WriteNetcdf(const std::vector<DataTable>& tables, const Provenance& provenance,
                 const std::string& path) {
  using Function = decltype(contactctl_write_netcdf);
  Exported<Function>("contactctl_write_netcdf")(tables, provenance, path);
}

void WriteMat(const std::vector<DataTable>& tables, const Provenance& provenance,
              const std::string& path) {
  Exported<decltype(contactctl_write_mat)>("contactctl_write_mat")(tables, provenance, path);
}

void DescribePdf(const std::string& title, const std::string& subject, std::string* picture) {
  using Function = decltype(contactctl_describe_pdf);
  Exported<Function>("contactctl_describe_pdf")(title, subject, picture);
}

}  // namespace contact::cli
