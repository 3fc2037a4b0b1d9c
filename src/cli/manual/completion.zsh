#compdef dyadel
# SPDX-License-Identifier: LGPL-3.0-or-later
# Completion of dyadel for zsh.
_dyadel() {
  local -a commands options
  local context state state_descr line
  typeset -A opt_args
  commands=(
{{commands}}  )
  _arguments -C '(-h --help)'{-h,--help}'[help]' '--version[the version]' '1:command:->command' '*::argument:->arguments' && return
  case $state in
  command) _describe command commands ;;
  arguments)
    case $line[1] in
{{options}}    esac
    _arguments $options ;;
  esac
}
_dyadel "$@"
