# Writes OUTPUT, the C++ source that holds the scenarios FILES as templates.
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  # A sweep has no title, but begins with a sentence that does for one.
  if(text MATCHES "\ntitle: ([^\n]*)")
    set(shows "${CMAKE_MATCH_1}")
  else()
    string(REGEX MATCH "\n# ([^:\n]*):" sentence "${text}")
    set(shows "${CMAKE_MATCH_1}, a sweep")
  endif()
  string(APPEND entries "    {\"${name}\", \"${shows}\", R\"yaml(${text})yaml\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"cli/input/templates.h\"

namespace contact::cli {
namespace {

constexpr Template kTemplates[] = {
${entries}};

}  // namespace

std::span<const Template> Templates() { return kTemplates; }

}  // namespace contact::cli
")
