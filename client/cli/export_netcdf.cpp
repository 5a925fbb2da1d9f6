#include "cli/export_netcdf.h"

#include <fmt/format.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <netcdf.h>
#include <openssl/sha.h>

#include <array>
#include <iterator>

#include "cli/render_json.h"

namespace contact::cli {
namespace {

// One netCDF file that is being written; removed by the caller if that fails.
class NetcdfFile {
 public:
  explicit NetcdfFile(const std::string& path) : path_(path) {
    Check(nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &file_));
    open_ = true;
  }
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;
  ~NetcdfFile() {
    if (open_) nc_close(file_);
  }

  void Attribute(const std::string& name, const std::string& text) {
    PutText(file_, NC_GLOBAL, name, text);
  }

  void Table(const DataTable& table) {
    int group = 0;
    int dimension = 0;
    Check(nc_def_grp(file_, table.name.c_str(), &group));
    Check(nc_def_dim(group, table.row.c_str(), table.rows(), &dimension));
    for (const DataColumn& column : table.columns) Variable(group, dimension, column);
  }

  void Close() {
    open_ = false;
    Check(nc_close(file_));
  }

 private:
  void Variable(int group, int dimension, const DataColumn& column) {
    const auto* numbers = std::get_if<std::vector<double>>(&column.values);
    int variable = 0;
    Check(nc_def_var(group, column.name.c_str(), numbers != nullptr ? NC_DOUBLE : NC_STRING, 1,
                     &dimension, &variable));
    PutText(group, variable, "units", column.unit.empty() ? "1" : column.unit);
    PutText(group, variable, "long_name", column.description);
    if (column.size() == 0) return;
    if (numbers != nullptr) {
      Check(nc_put_var_double(group, variable, numbers->data()));
      return;
    }
    std::vector<const char*> words;
    for (const std::string& word : std::get<std::vector<std::string>>(column.values)) {
      words.push_back(word.c_str());
    }
    Check(nc_put_var_string(group, variable, words.data()));
  }

  void PutText(int group, int variable, const std::string& name, const std::string& text) {
    Check(nc_put_att_text(group, variable, name.c_str(), text.size(), text.data()));
  }

  void Check(int status) const {
    if (status == NC_NOERR) return;
    throw Failure(ExitCode::kLocal, fmt::format("{}: {}", path_, nc_strerror(status)));
  }

  const std::string path_;
  int file_ = 0;
  bool open_ = false;
};

// Of the message as every language writes it: fields in order of their numbers.
std::string Sha256(const v1::Scenario& scenario) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream stream(&bytes);
    google::protobuf::io::CodedOutputStream out(&stream);
    out.SetSerializationDeterministic(true);
    scenario.SerializeToCodedStream(&out);
  }
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  std::string hex;
  for (const unsigned char byte : digest) fmt::format_to(std::back_inserter(hex), "{:02x}", byte);
  return hex;
}

}  // namespace

void WriteNetcdf(const std::vector<DataTable>& tables, const Attributes& attributes,
                 const std::string& path) {
  NetcdfFile file(path);
  for (const auto& [name, text] : attributes) file.Attribute(name, text);
  for (const DataTable& table : tables) file.Table(table);
  file.Close();
}

Attributes Provenance(const v1::Job& job, const std::string& revision) {
  return {{"title", job.scenario().title()},
          {"job", job.name()},
          {"scenario", ToJson(job.scenario())},
          {"scenario_sha256", Sha256(job.scenario())},
          {"version", job.server_version()},
          {"revision", revision},
          {"convergence", v1::Job::Convergence_Name(job.convergence())}};
}

}  // namespace contact::cli
