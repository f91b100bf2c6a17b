#!/bin/sh
# The exit status of tests/run.sh says the same as its last line: for a step that passes, for one that fails, and for a
# name that no step has.
BUILD=$1 passed=0 failed=0
export BUILD
check() {   # what, expected status, expected last line, variables...
    what=$1 status=$2 last=$3; shift 3
    said=$(env "$@" sh tests/run.sh 2>&1)
    found=$?
    if [ $found = "$status" ] && printf '%s\n' "$said" | tail -n 1 | grep -qx "$last"; then passed=$((passed + 1))
    else
        echo "FAIL $what: status $found instead of $status, or another last line than '$last':"
        printf '%s\n' "$said" | tail -n 5
        failed=$((failed + 1))
    fi
}
check "a step that passes" 0 '[1-9][0-9]* passed, 0 failed' ONLY=refusals
check "a step that cannot write" 1 '[0-9]* passed, [1-9][0-9]* failed' ONLY=refusals TMPDIR=/no/such/folder
check "a name without a step" 1 '0 passed, 1 failed' ONLY=no_such_step
echo "$passed passed, $failed failed"
[ $failed = 0 ]
