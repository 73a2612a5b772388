
_sandstroke() {
  local REPLY kind current word glue=''
  local -a line=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do  # readline splits words at =
    if [[ ${#line[@]} -gt 0 && ($word == '=' || -n $glue) ]]; then
      line[-1]+=$word
    else
      line+=("$word")
    fi
    [[ $word == '=' ]] && glue=yes || glue=''
  done
  _sandstroke_find "${line[@]}"
  COMPREPLY=()
  case $kind in
    words*)
      mapfile -t COMPREPLY < <(compgen -W "${kind#words}" -- "$current")
      [[ $kind == *: ]] && compopt -o nospace
      ;;
    settings)
      _sandstroke_settings
      mapfile -t COMPREPLY < <(compgen -W "$REPLY" -S = -- "$current")
      compopt -o nospace
      ;;
    scenes)
      for word in strokes/*/scene.toml; do
        word=${word#strokes/}
        word=${word%/scene.toml}
        [[ $word == "$current"* && $word != '*' ]] && COMPREPLY+=("$word")
      done
      ;;
    folder | files*)
      compopt -o filenames
      mapfile -t COMPREPLY < <(compgen -d -- "$current")
      [[ $kind == folder ]] && return
      for word in ${kind#files}; do
        mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -X "!*$word" -- "$current")
      done
      ;;
  esac
}
complete -F _sandstroke sandstroke
