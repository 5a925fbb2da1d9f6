# Writes OUTPUT, the C++ source that holds the scenarios FILES as templates.
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND entries "    {\"${name}\", R\"yaml(${text})yaml\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"cli/templates.h\"

namespace contact::cli {
namespace {

constexpr Template kTemplates[] = {
${entries}};

}  // namespace

std::span<const Template> Templates() { return kTemplates; }

}  // namespace contact::cli
")
