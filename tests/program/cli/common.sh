# Sourced by run.sh: how the parts run the program and look at what it says.

says() { grep -F -e "$1" "$tmp/out" "$tmp/err" >/dev/null; }
runs() { # runs NAME EXIT-CODE ARGUMENTS...: the program ends with this code; its output is in out and err
    name=$1 wanted=$2; shift 2
    "$harmorph" "$@" >"$tmp/out" 2>"$tmp/err"
    code=$?
    if [ $code -eq "$wanted" ]; then ok "$name"; else
        fail "$name: exit code $code and not $wanted"
        sed 's/^/     | /' "$tmp/err" | head -5
    fi
}
refuses() { # refuses NAME EXIT-CODE TEXT ARGUMENTS...: and the message contains the text
    name=$1 wanted=$2 text=$3; shift 3
    runs "$name" "$wanted" "$@"
    if grep -F -e "$text" "$tmp/err" >/dev/null; then ok "$name: says '$text'"; else
        fail "$name: does not say '$text'"
        sed 's/^/     | /' "$tmp/err" | head -5
    fi
}
has_keys() { # has_keys NAME KEY...: out is one JSON object of exactly these keys (keys of nested objects: name, faces)
    name=$1; shift
    keys=$(sed 's/{"name": [^}]*}//g' "$tmp/out" | grep -o '"[a-z_]*":' | tr -d '":' | tr '\n' ' ')
    if [ "$keys" = "$* " ] && [ "$(wc -l <"$tmp/out")" -eq 1 ]; then ok "$name"; else fail "$name: keys are $keys"; fi
}
leaves_nothing() { # leaves_nothing NAME FILE: neither the file nor a temporary one
    if ls "$2"* >/dev/null 2>&1; then fail "$1"; else ok "$1"; fi
}
makes() { # makes ARGUMENTS...: an input of checks, which is no check itself
    "$harmorph" "$@" >"$tmp/out" 2>"$tmp/err" || fail "an input cannot be made: $*" "$tmp/err"
}
number() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$tmp/out"; } # of the JSON object in out
# In the JSON object of a safe morph, whose worst cells are nested objects.
worst_cell="cell quality start_quality x y"
safe_keys="rotated_offset start_quality max_angle_change mean_angle_change min_height_ratio max_height_ratio
    end_point end_distance solutions may_improve warning
    worst_cells $worst_cell $worst_cell $worst_cell $worst_cell $worst_cell"
