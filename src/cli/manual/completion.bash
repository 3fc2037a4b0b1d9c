# SPDX-License-Identifier: LGPL-3.0-or-later
# Completion of dyadel for bash.
_dyadel() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} command='' words='' equals='' k
  COMPREPLY=()
  # bash takes --format=js for three words
  if [[ $cur == = ]]; then cur='' equals=1
  elif [[ $prev == = ]]; then prev=${COMP_WORDS[COMP_CWORD-2]} equals=1; fi
  for ((k = 1; k < COMP_CWORD; k++)); do
    case ${COMP_WORDS[k]} in
    {{alternatives}}) command=${COMP_WORDS[k]}; break ;;
    esac
  done
  case $prev in
{{values}}  esac
  if [[ -z $words && $cur == -* ]]; then
    case $command in
{{options}}    esac
  elif [[ -z $words && -z $command ]]; then words='{{commands}}'; fi
  [[ $words ]] || return # names of files
  compopt +o default 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$cur")
  [[ ${COMPREPLY[0]-} == *: ]] && compopt -o nospace 2>/dev/null
  return 0
}
complete -o default -F _dyadel dyadel
