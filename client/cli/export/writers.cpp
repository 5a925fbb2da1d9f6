#include "cli/export/writers.h"

namespace contact::cli {

TableWriter* TableWriterOf(OutputFormat format) {
  switch (format) {
#define TABLE_WRITER(enumerator, function) \
  case OutputFormat::enumerator:           \
    return function;
#include "cli/settings/formats.def"
    default:
      return nullptr;
  }
}

FileWriter* FileWriterOf(OutputFormat format) {
  switch (format) {
#define FILE_WRITER(enumerator, function) \
  case OutputFormat::enumerator:          \
    return function;
#include "cli/settings/formats.def"
    default:
      return nullptr;
  }
}

}  // namespace contact::cli
