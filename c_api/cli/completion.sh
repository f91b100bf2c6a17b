#!/bin/sh
# usage: completion.sh >FILE   Writes the completion of commands, options and names of files for bash, from the texts of
# the commands.
cd "$(dirname "$0")/commands" || exit 1
set -- $(ls ./*.txt | grep -vE '/(shared|harmorph)\.txt$')
printf '# Made by c_api/cli/completion.sh.\n_harmorph() {\n'
printf '    local word=${COMP_WORDS[COMP_CWORD]} words="help --help --version%s"\n' \
    "$(for text; do basename "$text" .txt; done | sed 's/^/ /' | tr -d '\n')"
printf '    if [ "$COMP_CWORD" -gt 1 ]; then\n        case ${COMP_WORDS[1]} in\n'
awk '
    function close_command() { if (command != "") print "        " command ") words=\"--help" options "\" ;;" }
    FNR == 1 { close_command(); command = $1; options = ""; begun = 0; next }
    $0 == "Options:" { begun = 1 }
    begun && /^-/ { for (k = 1; k <= NF && $k !~ /^\(/; ++k) if ($k ~ /^-/) options = options " " $k }
    END { close_command() }' "$@"
printf '        help) ;;\n        *) words= ;;\n        esac\n    fi\n'
cat <<'END'
    if [ "$COMP_CWORD" -gt 1 ] && [ "${word#-}" = "$word" ] && [ "${COMP_WORDS[1]}" != help ]; then
        compopt -o filenames 2>/dev/null
        COMPREPLY=($(compgen -f -- "$word"))
    else
        COMPREPLY=($(compgen -W "$words" -- "$word"))
    fi
}
complete -F _harmorph harmorph
END
