# Completion of contactctl for bash 4 or later. In ~/.bashrc:
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
