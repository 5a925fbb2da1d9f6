// The module itself: hands on what it is asked for. Its own WriteNetcdf, WriteMat and
// DescribePdf do the work.
#include "cli/formats_module.h"

#include "cli/export_mat.h"
#include "cli/export_netcdf.h"
#include "cli/pdf_source.h"

namespace contact::cli {

[[gnu::visibility("default")]] void contactctl_write_netcdf(const std::vector<DataTable>& tables,
                                                            const Provenance& provenance,
                                                            const std::string& path) {
  WriteNetcdf(tables, provenance, path);
}

[[gnu::visibility("default")]] void contactctl_write_mat(const std::vector<DataTable>& tables,
                                                         const Provenance& provenance,
                                                         const std::string& path) {
  WriteMat(tables, provenance, path);
}

[[gnu::visibility("default")]] void contactctl_describe_pdf(const std::string& title,
                                                            const std::string& subject,
                                                            std::string* picture) {
  DescribePdf(title, subject, picture);
}

}  // namespace contact::cli
