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
#include "cli/export/writers.h"

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

// A struct of one element, in which the value of field i is value(i).
Variable Struct(const char* name, const std::vector<std::string>& fields,
                const std::function<Variable(std::size_t)>& value) {
  std::vector<const char*> texts;
  for (const std::string& field : fields) texts.push_back(field.c_str());
  std::array<std::size_t, 2> size{1, 1};
  Variable all = Owned(
      Mat_VarCreateStruct(name, 2, size.data(), texts.data(), static_cast<unsigned>(texts.size())));
  for (std::size_t i = 0; i < fields.size(); ++i) {
    Mat_VarSetStructFieldByIndex(all.get(), i, 0, value(i).release());
  }
  return all;
}

// The names of tables or of columns.
template <class Part>
std::vector<std::string> NamesOf(const std::vector<Part>& parts) {
  std::vector<std::string> names;
  for (const Part& part : parts) names.push_back(part.name);
  return names;
}

using Show = std::function<Variable(const DataColumn&)>;

// A struct with a field for each column.
Variable ForEachColumn(const char* name, const DataTable& table, const Show& show) {
  return Struct(name, MatlabNames(NamesOf(table.columns)),
                [&](std::size_t i) { return show(table.columns[i]); });
}

// The same of all tables, each in a field of its own.
Variable ForEachTable(const char* name, const std::vector<DataTable>& tables, const Show& show) {
  return Struct(name, NamesOf(tables),
                [&](std::size_t i) { return ForEachColumn(nullptr, tables[i], show); });
}

Variable Sources(const Provenance& provenance) {
  std::vector<std::string> names;
  for (const auto& [name, text] : provenance) names.push_back(name);
  return Struct("provenance", names, [&](std::size_t i) { return Text(provenance[i].second); });
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

// A MAT file of version 5: a struct for each table, in it a column vector for each column, words as
// a cell array. The structs `units`, `descriptions` and `names` tell of each column what the table
// has, `provenance` where it comes from. Names of columns become valid for MATLAB and stay apart:
// `B1-B2.contact_force` is `B1_B2_contact_force`.
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
