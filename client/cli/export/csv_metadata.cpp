#include "cli/export/csv_metadata.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/base/text_file.h"

namespace contact::cli {
namespace {

using Json = nlohmann::ordered_json;

Json Described(const DataColumn& column) {
  const bool numbers = std::holds_alternative<std::vector<double>>(column.values);
  Json described = {{"titles", column.Header()}, {"datatype", numbers ? "double" : "string"}};
  if (!column.description.empty()) described["dc:description"] = column.description;
  return described;
}

Json Note(const Provenance& source) {
  Json note;
  for (const auto& [name, value] : source) note[name] = value;
  return note;
}

}  // namespace

void WriteCsvMetadata(const std::vector<DataColumn>& columns,
                      const std::vector<Provenance>& sources, const std::string& path) {
  Json json = {{"@context", "http://www.w3.org/ns/csvw"},
               {"url", std::filesystem::path(path).filename().string()}};
  for (const DataColumn& column : columns) {
    json["tableSchema"]["columns"].push_back(Described(column));
  }
  for (const Provenance& source : sources) json["notes"].push_back(Note(source));
  WriteText(json.dump(2) + "\n", path + "-metadata.json");
}

}  // namespace contact::cli
