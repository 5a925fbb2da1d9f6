# contact_embed(<output> <header> <type> <function> <entries>): writes the C++ source <output>. It
# defines <function>, which <header> declares in contact::cli: a span of the <entries>, each of <type>.
function(contact_embed output header type function entries)
  file(WRITE ${output} "#include \"${header}\"

namespace contact::cli {
namespace {

constexpr ${type} kEntries[] = {
${entries}};

}  // namespace

std::span<const ${type}> ${function}() { return kEntries; }

}  // namespace contact::cli
")
endfunction()
