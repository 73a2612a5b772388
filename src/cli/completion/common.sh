
# Sets `kind` to what the last of these words can be, and `current` to what is typed of it. For bash and zsh.
_sandstroke_find() {
  local word option='' position=1 command=''
  while (( $# > 1 )); do
    word=$1
    shift
    if [[ -n $option ]]; then
      option=''
    elif [[ $word == -*=* ]]; then
      :
    elif [[ $word == -* ]]; then
      _sandstroke_value "$command" "$word"
      [[ -n $REPLY ]] && option=$word
    else
      _sandstroke_commands "$command"
      if [[ " $REPLY " == *" $word "* ]]; then
        command="${command:+$command }$word"
        position=1
      else
        (( position += 1 ))
      fi
    fi
  done
  current=$1
  if [[ -z $option && $current == -*=* ]]; then
    option=${current%%=*}
    current=${current#*=}
  fi
  if [[ -n $option ]]; then
    _sandstroke_value "$command" "$option"
    [[ -z $REPLY ]] && _sandstroke_value "$command" "$option="  # a flag's
  elif [[ $current == -* ]]; then
    _sandstroke_options "$command"
    REPLY="words $REPLY"
  else
    _sandstroke_value "$command" "$position"
    kind=$REPLY
    _sandstroke_commands "$command"
    if [[ -n $REPLY && " $REPLY" == *" $current"* && ( -z $kind || -n $current ) ]]; then
      REPLY="words $REPLY"
    else
      REPLY=$kind
    fi
  fi
  kind=$REPLY
  if [[ $kind == settings && $current == *=* ]]; then
    _sandstroke_setting "${current%%=*}"
    kind="words $REPLY"
    current=${current#*=}
  fi
}
