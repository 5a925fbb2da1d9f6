#include "cli/pdf_source.h"

#include <qpdf/qpdf-c.h>

#include <memory>
#include <type_traits>

#include "cli/failure.h"

namespace contact::cli {
namespace {

struct EndPdf {
  void operator()(qpdf_data pdf) const { qpdf_cleanup(&pdf); }
};
using Pdf = std::unique_ptr<std::remove_pointer_t<qpdf_data>, EndPdf>;

void Check(const Pdf& pdf, QPDF_ERROR_CODE code) {
  if ((static_cast<unsigned>(code) & QPDF_ERRORS) == 0) return;
  throw Failure(ExitCode::kLocal, qpdf_get_error_full_text(pdf.get(), qpdf_get_error(pdf.get())));
}

}  // namespace

void DescribePdf(const std::string& title, const std::string& subject, std::string* picture) {
  const Pdf pdf(qpdf_init());
  Check(pdf, qpdf_read_memory(pdf.get(), "picture", picture->data(), picture->size(), nullptr));
  const qpdf_oh about = qpdf_oh_get_key(pdf.get(), qpdf_get_trailer(pdf.get()), "/Info");
  const auto set = [&](const char* key, const std::string& text) {
    qpdf_oh_replace_key(pdf.get(), about, key, qpdf_oh_new_unicode_string(pdf.get(), text.c_str()));
  };
  set("/Title", title);
  set("/Subject", subject);
  qpdf_oh_remove_key(pdf.get(), about, "/CreationDate");
  Check(pdf, qpdf_init_write_memory(pdf.get()));
  qpdf_set_deterministic_ID(pdf.get(), QPDF_TRUE);
  Check(pdf, qpdf_write(pdf.get()));
  const auto* written = reinterpret_cast<const char*>(qpdf_get_buffer(pdf.get()));
  picture->assign(written, qpdf_get_buffer_length(pdf.get()));
}

}  // namespace contact::cli
