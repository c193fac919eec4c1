# Completion of rink and rink-COMMAND in bash. Commands and flags are those that --help prints, so this list cannot grow old.
_rink() {
  local word=${COMP_WORDS[COMP_CWORD]} program=$1 folder
  COMPREPLY=()
  if [[ ${program##*/} == rink ]]; then
    program=$(type -P -- "$program") || return
    if ((COMP_CWORD == 1)); then
      COMPREPLY=($(compgen -W "$("$program" help | sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p') --help --version" -- "$word"))
      return
    fi
    # In a source tree the launcher would build first; only what is built already is asked.
    folder=$(dirname -- "$(readlink -f -- "$program")")
    [[ -f $folder/CMakeLists.txt ]] && folder=$folder/build/bin
    program=$folder/rink-${COMP_WORDS[1]}
  fi
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$("$program" --help 2>/dev/null | grep -oE -- '--[a-z][a-z-]*' | sort -u)" -- "$word"))
  else
    COMPREPLY=($(compgen -f -- "$word"))
  fi
}
complete -o filenames -F _rink rink rink-compare rink-replay rink-serve rink-rti rink-bots rink-dds rink-peer rink-play rink-duel rink-simulate rink-accuracy
