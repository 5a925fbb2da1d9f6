#include "cli/export/export_mat.h"

#include <fmt/format.h>
#include <matio.h>

#include <array>
#include <boost/locale/encoding_utf.hpp>
#include <cstddef>
#include <functional>
#include <memory>
#include <utility>

#include "cli/base/failure.h"
#include "cli/export/matlab_names.h"

namespace contact::cli {
namespace {

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

Variable Owned(matvar_t* variable) {
  if (variable == nullptr) throw std::bad_alloc();
  return Variable(variable);
}

// A row of characters, of the kind that every reader knows.
Variable Text(const std::string& text) {
  std::u16string units = boost::locale::conv::utf_to_utf<char16_t>(text);
  std::array<std::size_t, 2> size{units.empty() ? 0U : 1U, units.size()};
  return Owned(Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF16, 2, size.data(), units.data(), 0));
}

Variable Column(const std::vector<double>& numbers) {
  std::array<std::size_t, 2> size{numbers.size(), 1};
  return Owned(Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(),
                             const_cast<double*>(numbers.data()), 0));  // NOLINT: it is copied.
}

Variable Column(const std::vector<std::string>& words) {
  std::array<std::size_t, 2> size{words.size(), 1};
  std::vector<matvar_t*> entries;
  entries.reserve(words.size());
  for (const std::string& word : words) entries.push_back(Text(word).release());
  return Owned(Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, size.data(), entries.data(), 0));
}

// A struct of one element, which owns its fields.
class Struct {
 public:
  Struct(const char* name, const std::vector<std::string>& fields) : fields_(fields) {
    std::vector<const char*> texts;
    texts.reserve(fields_.size());
    for (const std::string& field : fields_) texts.push_back(field.c_str());
    std::array<std::size_t, 2> size{1, 1};
    variable_ = Owned(Mat_VarCreateStruct(name, 2, size.data(), texts.data(),
                                          static_cast<unsigned>(texts.size())));
  }

  void Set(std::size_t field, Variable value) {
    Mat_VarSetStructFieldByName(variable_.get(), fields_[field].c_str(), 0, value.release());
  }

  Variable Take() { return std::move(variable_); }

 private:
  std::vector<std::string> fields_;
  Variable variable_;
};

std::vector<std::string> FieldsOf(const DataTable& table) {
  std::vector<std::string> names;
  names.reserve(table.columns.size());
  for (const DataColumn& column : table.columns) names.push_back(column.name);
  return MatlabNames(names);
}

using Show = std::function<Variable(const DataColumn&)>;

// A struct with a field for each column.
Variable ForEachColumn(const char* name, const DataTable& table, const Show& show) {
  Struct all(name, FieldsOf(table));
  for (std::size_t i = 0; i < table.columns.size(); ++i) all.Set(i, show(table.columns[i]));
  return all.Take();
}

// The same of all tables, each in a field of its own.
Variable ForEachTable(const char* name, const std::vector<DataTable>& tables, const Show& show) {
  std::vector<std::string> names;
  names.reserve(tables.size());
  for (const DataTable& table : tables) names.push_back(table.name);
  Struct all(name, names);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    all.Set(i, ForEachColumn(nullptr, tables[i], show));
  }
  return all.Take();
}

Variable Sources(const Provenance& provenance) {
  std::vector<std::string> names;
  names.reserve(provenance.size());
  for (const auto& [name, text] : provenance) names.push_back(name);
  Struct all("provenance", names);
  for (std::size_t i = 0; i < provenance.size(); ++i) all.Set(i, Text(provenance[i].second));
  return all.Take();
}

class MatFile {
 public:
  explicit MatFile(const std::string& path)
      : path_(path),
        file_(
            Mat_CreateVer(path.c_str(), "MATLAB 5.0 MAT-file, created by contactctl", MAT_FT_MAT5),
            Mat_Close) {
    if (file_ == nullptr) Fail();
  }

  void Write(const Variable& variable) {
    if (Mat_VarWrite(file_.get(), variable.get(), MAT_COMPRESSION_NONE) != 0) Fail();
  }

  void Close() {
    if (Mat_Close(file_.release()) != 0) Fail();
  }

 private:
  [[noreturn]] void Fail() const {
    throw Failure(ExitCode::kLocal, fmt::format("{}: cannot be written", path_));
  }

  const std::string path_;
  std::unique_ptr<mat_t, int (*)(mat_t*)> file_;
};

}  // namespace

void WriteMat(const std::vector<DataTable>& tables, const Provenance& provenance,
              const std::string& path) {
  MatFile file(path);
  for (const DataTable& table : tables) {
    file.Write(ForEachColumn(table.name.c_str(), table, [](const DataColumn& column) {
      return std::visit([](const auto& values) { return Column(values); }, column.values);
    }));
  }
  file.Write(ForEachTable("units", tables, [](const auto& column) { return Text(column.unit); }));
  file.Write(ForEachTable("descriptions", tables,
                          [](const auto& column) { return Text(column.description); }));
  file.Write(ForEachTable("names", tables, [](const auto& column) { return Text(column.name); }));
  file.Write(Sources(provenance));
  file.Close();
}

}  // namespace contact::cli
