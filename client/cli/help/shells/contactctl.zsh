#compdef contactctl
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
