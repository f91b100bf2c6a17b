#!/bin/sh
# usage: run.sh BUILD [POINTS AROUND [REPEATS]]   Processor time of hm_quality_bounds in multiples of hm_assess.
build=${1:?usage: run.sh BUILD}
: "${CC:=cc}" "${CFLAGS:=-O2}"
shift
$CC -std=gnu99 -Wall -Wextra $CFLAGS -Iinclude -o "$build/bounds" tests/measure/bounds/bounds.c "$build/libharmorph.a" \
    $LDFLAGS -lm || exit
exec "$build/bounds" "$@"
