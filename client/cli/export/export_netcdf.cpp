#include <fmt/format.h>
#include <netcdf.h>

#include <utility>

#include "cli/base/failure.h"
#include "cli/export/writers.h"

namespace contact::cli {
namespace {

// One netCDF file that is being written.
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

}  // namespace

// A netCDF-4 file (which is HDF5): a group for each table, in it a variable for each column with
// `units` and `long_name`; the provenance as global attributes.
void WriteNetcdf(const std::vector<DataTable>& tables, const Provenance& provenance,
                 const std::string& path) {
  NetcdfFile file(path);
  for (const auto& [name, text] : provenance) file.Attribute(name, text);
  for (const DataTable& table : tables) file.Table(table);
  file.Close();
}

}  // namespace contact::cli
