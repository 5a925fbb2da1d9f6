# Writes OUTPUT, the C++ source that holds the completion scripts FILES, each named contactctl.SHELL.
set(entries "")
foreach(file IN LISTS FILES)
  get_filename_component(shell ${file} EXT)
  string(SUBSTRING ${shell} 1 -1 shell)
  file(READ ${file} text)
  string(APPEND entries "    {\"${shell}\", R\"script(${text})script\"},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"cli/help/completion.h\"

namespace contact::cli {
namespace {

constexpr ShellScript kScripts[] = {
${entries}};

}  // namespace

std::span<const ShellScript> ShellScripts() { return kScripts; }

}  // namespace contact::cli
")
