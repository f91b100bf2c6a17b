#!/bin/sh
# usage: benchmarks.sh BUILD
# The sources of `make bench` compile with its flags and without a warning, but for the peers, which need other
# libraries.
topic=benchmarks log=$1/benchmarks.log
. "$(dirname "$0")/../count.sh"
flags=$(sed -nE 's/^(flags|paths)="(.*)"$/\2/p' tests/measure/bench/run.sh)
for source in $(ls tests/measure/bench/*.cpp | grep -v /peer_); do
    check "$source" ${CXX:-c++} $flags -Werror -DBENCH_FLAGS='""' -fsyntax-only "$source"
done
finish
