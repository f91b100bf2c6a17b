#!/bin/sh
# Called by `make fuzz`: all targets under the address and undefined-behaviour sanitizers, float-cast-overflow among
# these, for FUZZ_SECONDS together; TARGETS="shape files": some of these. With clang, libFuzzer looks for cases that run
# through new code; without, cases are random. The last line counts executions, edges of the control flow that were
# seen, and findings, whose cases are kept.
: "${MAKE:=make}" "${BUILD:=build}" "${JOBS:=2}" "${FUZZ_SECONDS:=60}" "${CLANG:=clang++}"
dir=$BUILD/fuzz
mkdir -p "$dir"
checks="address,undefined,float-cast-overflow"
# The branches that are taken guide libFuzzer. The operands of comparisons could guide it as well, but nearly all of
# them are coordinates and pointers in loops, and recording them took six tenths of the time.
followed=-fsanitize-coverage=inline-8bit-counters,pc-table
targets="problem polygons basis sequence files shape given parts plane transfer commands model fields quality sections"
targets="$targets tables"
if [ -n "${TARGETS-}" ]; then targets=$TARGETS; fi
n=$(set -- $targets; echo $#)
each=$((FUZZ_SECONDS / n > 0 ? FUZZ_SECONDS / n : 1))
flags="-g1 -fno-omit-frame-pointer -fno-sanitize-recover=all"
executions=0 edges=0 findings=0
# Blocks that were freed are kept for a while, to see who still uses them: little memory, which stays in the cache.
export ASAN_OPTIONS="quarantine_size_mb=8:malloc_context_size=8${ASAN_OPTIONS:+:$ASAN_OPTIONS}"

# Kernels are unrolled for each set of registers: clang takes many minutes to optimise them with their checks.
build() {   # compiler, flags to compile, flags to link, flags of files whose branches are followed
    $MAKE -s JOBS="$JOBS" BUILD="$dir" WASM_CXX=none CXX="$1" \
        LEVEL="-O2 ${4-}" KERNEL_LEVEL=-O1 PROGRAM_LEVEL="-O2 ${4-}" \
        CXXFLAGS="$flags $2" LDFLAGS="$3" fuzzer || exit 1
}
run_libfuzzer() {   # target
    mkdir -p "$dir/$1" "$dir/findings"
    seeds=
    if [ -d "tests/fuzz/corpus/$1" ]; then seeds=tests/fuzz/corpus/$1; fi
    HARMORPH_TARGET=$1 "$dir/fuzzer" -max_total_time=$each -max_len=4096 -timeout=60 -rss_limit_mb=4096 \
        -entropic_scale_per_exec_time=1 -print_funcs=0 -print_final_stats=1 -artifact_prefix="$dir/findings/$1-" \
        "$dir/$1" $seeds >"$dir/$1.log" 2>&1 || {
        findings=$((findings + 1))
        tail -n 30 "$dir/$1.log"
    }
    n=$(sed -n 's/^stat::number_of_executed_units: *//p' "$dir/$1.log")
    seen=$(sed -n 's/.* cov: \([0-9]*\) .*/\1/p' "$dir/$1.log" | tail -n 1)
    echo "$1: ${n:-0} executions, ${seen:-0} edges"
    executions=$((executions + ${n:-0})) edges=$((edges + ${seen:-0}))
}
run_random() {   # target
    end=$(($(date +%s) + each)) seed=1
    while [ "$(date +%s)" -lt $end ]; do
        seed=$((seed + 1))
        "$dir/fuzzer" "$1" 500 $seed >"$dir/$1.log" 2>&1 || {
            findings=$((findings + 1))
            tail -n 30 "$dir/$1.log"
        }
        executions=$((executions + 500))
    done
}

echo 'extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }' >"$dir/probe.cpp"
if $CLANG -fsanitize=fuzzer,$checks "$dir/probe.cpp" -o "$dir/probe" 2>/dev/null; then
    build "$CLANG" "-DLIBFUZZER -fsanitize=$checks" "-fsanitize=fuzzer,$checks" "$followed"
    for target in $targets; do run_libfuzzer $target; done
else
    echo "no libFuzzer: $CLANG is not installed or has none (Debian: clang); cases are random"
    build "${CXX:-c++}" "-fsanitize=address,undefined" "-fsanitize=address,undefined"
    for target in $targets; do run_random $target; done
fi
echo "$executions executions, $edges edges seen, $findings findings"
[ $findings = 0 ]
