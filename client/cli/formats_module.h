#pragma once

#include <string>
#include <vector>

#include "cli/data_table.h"
#include "cli/provenance.h"

namespace contact::cli {

/// The libraries of netCDF, MAT and PDF bring forty others along, which would cost every command a
/// third of its start. So what needs them is in a module of its own, contactctl-formats.so, which
/// WriteNetcdf, WriteMat and DescribePdf load when they are called. These are the functions that it
/// exports.
extern "C" {
void contactctl_write_netcdf(const std::vector<DataTable>& tables, const Provenance& provenance,
                             const std::string& path);
void contactctl_write_mat(const std::vector<DataTable>& tables, const Provenance& provenance,
                          const std::string& path);
void contactctl_describe_pdf(const std::string& title, const std::string& subject,
                             std::string* picture);
}

}  // namespace contact::cli
