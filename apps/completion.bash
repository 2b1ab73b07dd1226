# Completion by bash, of subcommands and options as the program's own --help tells them.
_sigmax_demo() {
  local words=
  if [ "$COMP_CWORD" -eq 1 ]; then
    words=$("$1" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
  elif [[ $2 == -* ]]; then
    words=$("$1" "${COMP_WORDS[1]}" --help | sed -n 's/^  \(-h,\)\{0,1\}\(--[a-z-]*\).*/\2/p')
  fi
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$2")
}
complete -o default -F _sigmax_demo himm_demo recognition_demo
