#include "cli/figures/provenance_stamp.h"

#include <gmock/gmock.h>

#include "cli/base/text_file.h"
#include "cli/figures/draw.h"
#include "testing/sample_run.h"
#include "testing/temp_directory.h"

namespace contact::cli {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const std::vector<Provenance> kSources{{{"job", "jobs/<x>"}, {"revision", "a\nb"}}};

std::string Stamped(OutputFormat format, const std::string& drawn) {
  const TempDirectory folder;
  const std::string path = folder.path() / "figure";
  WriteText(drawn, path);
  StampProvenance(format, path, "a & μ", kSources);
  return ReadText(path);
}

TEST(StampProvenance, SvgHasThemInTheElementsThatGnuplotWrote) {
  EXPECT_EQ(Stamped(OutputFormat::kSvg, "<svg><title>Gnuplot</title><desc>by g</desc></svg>"),
            "<svg><title>a &amp; μ</title><desc>job: jobs/&lt;x&gt;\nrevision: a b\n</desc></svg>");
}

TEST(StampProvenance, TikzHasThemAsCommentsAndNoTime) {
  EXPECT_EQ(Stamped(OutputFormat::kTikz, "%% Gnuplot 5.4, 12:00\n\\begin{tikzpicture}\n"),
            "% job: jobs/<x>\n% revision: a b\n% \\usepackage{gnuplot-lua-tikz}\n"
            "\\begin{tikzpicture}\n");
}

TEST(StampProvenance, CharactersEndWithThem) {
  EXPECT_THAT(Stamped(OutputFormat::kText, "\fa   \n  b \n\n\n"),
              AllOf(StartsWith("a\n  b\n\n"), EndsWith("\n"), Not(HasSubstr("\f"))));
}

// A file as cairo 1.16 ends it.
std::string Pdf() {
  const std::string body =
      "%PDF-1.5\n7 0 obj\n<< /Producer (cairo)\n   /CreationDate (D:20261122102558Z)\n>>\nendobj\n"
      "8 0 obj\n<< /Type /Catalog >>\nendobj\n";
  return body +
         "xref\n0 1\n0000000000 65535 f \ntrailer\n<< /Size 9\n   /Root 8 0 R\n   /Info 7 0 R\n"
         ">>\nstartxref\n" +
         std::to_string(body.size()) + "\n%%EOF\n";
}

TEST(StampProvenance, PdfGetsANewInformationDictionaryAndLosesTheTime) {
  const std::string pdf = Stamped(OutputFormat::kPdf, Pdf());
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
  EXPECT_THAT(pdf, HasSubstr("/Title <FEFF006100200026002003BC>"));
  const std::size_t table = std::stoul(pdf.substr(pdf.rfind("startxref") + 10));
  EXPECT_EQ(pdf.substr(table, 9), "xref\n7 1\n");
  const std::size_t info = std::stoul(pdf.substr(table + 9, 10));
  EXPECT_EQ(pdf.substr(info, 7), "7 0 obj");
  EXPECT_EQ(info, Pdf().size());  // Everything before it stands where it stood.
  EXPECT_THAT(pdf, HasSubstr("/Size 9 /Root 8 0 R /Info 7 0 R /Prev "));
}

TEST(StampProvenance, APdfOfAnotherProgramIsLeftAlone) {
  EXPECT_EQ(Stamped(OutputFormat::kPdf, "%PDF-1.5\ntrailer\n<< /Size 9 >>\n"),
            "%PDF-1.5\ntrailer\n<< /Size 9 >>\n");
}

TEST(Draw, PngHasItsTextsAfterTheHeader) {
  const TempDirectory folder;
  const std::string path = folder.path() / "figure.png";
  const Figure figure{
      .title = "a & μ",
      .panels = {{.x_label = "x", .y_label = "y", .curves = {{.x = {0, 1}, .y = {0, 1}}}}},
      .sources = kSources};
  Draw(figure, OutputFormat::kPng, path);
  const std::string png = ReadText(path);
  EXPECT_EQ(png.substr(12, 4), "IHDR");
  EXPECT_EQ(png.substr(33 + 4, 9), "iTXtTitle");
  EXPECT_THAT(png, HasSubstr("a & μ"));
}

}  // namespace
}  // namespace contact::cli
