
_sandstroke() {
  local REPLY kind current
  _sandstroke_find "${(@)words[2,CURRENT]}"
  if [[ $kind != settings && $words[CURRENT] == *"=$current" ]]; then compset -P '*='; fi
  case $kind in
    words*) compadd -- ${=kind#words} ;;
    settings)
      _sandstroke_settings
      compadd -S = -- ${=REPLY}
      ;;
    scenes) compadd -- strokes/*/scene.toml(N:h:t) ;;
    folder) _files -/ ;;
    files*)
      local -a endings=(${=kind#files})
      endings=(${endings#.})
      _files -g "*.(${(j:|:)endings}|)"  # with a | it is an alternative, not a qualifier
      ;;
  esac
}
if [[ $funcstack[1] == _sandstroke ]]; then _sandstroke "$@"; else compdef _sandstroke sandstroke; fi
