#include <map>

#include "cli/help/completion.h"

namespace contact::cli {
namespace {

constexpr char kBash[] = R"bash(# Completion of contactctl for bash 4 or later. In ~/.bashrc:
#   source <(contactctl completion bash)
_contactctl() {
  local word=${COMP_WORDS[COMP_CWORD]} line rule=:none
  [[ $word == = ]] && word=
  COMPREPLY=()
  while IFS= read -r line; do
    case $line in
      :*) rule=$line ;;
      *) COMPREPLY+=("${line%%$'\t'*}") ;;
    esac
  done < <("${COMP_WORDS[0]}" __complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  case $rule in
    :files) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "$word") ;;
    :scenarios) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(
      compgen -d -- "$word"; compgen -f -X '!*.@(yaml|yml|json)' -- "$word") ;;
    :directories) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$word") ;;
    :nospace) compopt -o nospace 2>/dev/null; return ;;
    *) return ;;
  esac
  compopt -o filenames 2>/dev/null
}
shopt -s extglob
complete -F _contactctl contactctl
)bash";

constexpr char kZsh[] = R"zsh(#compdef contactctl
# Completion of contactctl for zsh. In ~/.zshrc, after compinit:
#   source <(contactctl completion zsh)
_contactctl() {
  local line rule=:none
  local -a candidates
  while IFS= read -r line; do
    case $line in
      :*) rule=$line ;;
      *) candidates+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}") ;;
    esac
  done < <("${words[1]}" __complete "${(@)words[2,CURRENT]}" 2>/dev/null)
  local -a goes_on
  [[ $rule == :nospace ]] && goes_on=(-S '')
  (( ${#candidates} )) && _describe contactctl candidates "${goes_on[@]}"
  case $rule in
    :files) _files ;;
    :scenarios) _files -g '*.(yaml|yml|json)' ;;
    :directories) _files -/ ;;
  esac
  return 0
}
compdef _contactctl contactctl
)zsh";

constexpr char kFish[] = R"fish(# Completion of contactctl for fish. In ~/.config/fish/config.fish:
#   contactctl completion fish | source
function __contactctl_complete
    set -l words (commandline -opc) (commandline -ct)
    set -l word (commandline -ct)
    for line in ($words[1] __complete $words[2..-1] 2>/dev/null)
        switch $line
            case ':files'
                __fish_complete_path $word
            case ':scenarios'
                __fish_complete_suffix .yaml
                __fish_complete_suffix .yml
                __fish_complete_suffix .json
            case ':directories'
                __fish_complete_directories $word
            case ':none' ':nospace'
            case '*'
                echo $line
        end
    end
end
complete -c contactctl -f -a '(__contactctl_complete)'
)fish";

}  // namespace

std::string CompletionScript(const std::string& shell) {
  static const std::map<std::string, const char*> kScripts = {
      {"bash", kBash}, {"zsh", kZsh}, {"fish", kFish}};
  return kScripts.at(shell);
}

}  // namespace contact::cli
