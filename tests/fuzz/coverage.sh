#!/bin/sh
# Called by `make coverage`: which branches of the core and of the C interface the C++ tests and the random problems
# take, by gcc and gcov. A branch of a template counts as taken if one of its instances takes it. $BUILD/coverage/missed
# lists the others by line. A line for each folder counts its branches, the last one all of them, and the places where
# something is refused.
: "${MAKE:=make}" "${BUILD:=build}" "${JOBS:=2}" "${CXX:=c++}" "${GCOV:=gcov}"
dir=$BUILD/coverage
$MAKE -s BUILD="$BUILD" JOBS="$JOBS" all fuzzer tests-only || exit 1
$MAKE -s BUILD="$dir" JOBS="$JOBS" CXX="$CXX" CXXFLAGS="-O0 --coverage" library-only || exit 1
rm -f "$dir"/objects/core/*.gcda
$CXX --coverage -pthread -o "$dir/tests" $(cat "$BUILD/objects/tests.list") "$dir/libharmorph.a" || exit 1
$CXX --coverage -pthread -o "$dir/fuzzer" "$BUILD"/objects/fuzz/*.o \
    $(cat "$BUILD/objects/program.list") "$dir/libharmorph.a" || exit 1
# In two halves side by side: gcov adds up what several processes have counted. Without optimisation this is most of the
# time, a third of it in the tests of the engines that iterate.
half="*tests/multigrid/*,*tests/operators/*,*tests/direct/*,*tests/safe/*"
# Left out: the tests that take longest and reach nothing that shorter ones do not.
long="a function's bits do not depend on the engine's blocks*,airfoils of all kinds are fitted*"
long="$long,curves through airfoils*"
"$dir/tests" -sf="$half" -tce="$long" >"$dir/log.engines" &
engines=$!
"$dir/tests" -sfe="$half" -tce="$long" >"$dir/log" || { cat "$dir/log"; exit 1; }
wait $engines || { cat "$dir/log.engines"; exit 1; }
for run in "problem 6000" "basis 2000" "sequence 1000" "polygons 600" "given 600" "parts 400" "plane 400" \
    "shape 600"; do
    "$dir/fuzzer" $run 1 >>"$dir/log" || exit 1
done
for notes in "$dir"/objects/core/*.gcno; do
    $GCOV -b -c -t "$notes" 2>/dev/null
done | awk -F: '
    $2 + 0 == 0 && $3 == "Source" {
        file = $4
        ours = file ~ /^(src|include|c_api)\//
    }
    !ours { next }
    /^ *([0-9]+\*?|#####|=====|-): *[1-9][0-9]*:/ {
        line = file ":" $2 + 0
        text = $0
        sub(/^[^:]*:[^:]*:/, "", text)
        of[line] = text
        if (text ~ /refuse\(/ && text !~ /auto const refuse|Status refuse/ && $1 !~ /-/) {
            refusal[line] += 0
            if ($1 !~ /#####|=====/) refusal[line] = 1
        }
        next
    }
    /^branch/ {
        split($0, word, " ")
        # If a kernel is inlined many times into one line, all copies count as one branch, taken or not.
        key = line " " (word[2] < 8 ? word[2] : word[2] % 2)
        if (!(key in taken)) taken[key] = 0
        if ($0 ~ /taken/ && word[4] + 0 > 0) taken[key] = 1
    }
    END {
        for (key in taken) {
            split(key, part, " ")
            split(part[1], place, ":")
            ++all
            ++of_file[place[1]]
            hit += taken[key]
            hit_of[place[1]] += taken[key]
            folder = place[1]
            sub(/\/[^\/]*$/, "", folder)
            ++of_folder[folder]
            hit_in[folder] += taken[key]
            if (!taken[key]) missed[part[1]] = missed[part[1]] " " part[2]
        }
        for (line in missed) print "missed " line ": branch" missed[line] ":" of[line]
        for (line in refusal) {
            ++refusals
            seen += refusal[line]
            if (!refusal[line]) print "refusal " line ": never reached:" of[line]
        }
        for (folder in of_folder)
            printf "folder %s %d of %d branches, %.1f %%\n", folder, hit_in[folder], of_folder[folder],
                100 * hit_in[folder] / of_folder[folder]
        for (file in of_file) printf "file %s %d of %d\n", file, hit_of[file], of_file[file]
        printf "%d of %d branches taken (%.1f %%), ", hit, all, 100 * hit / all
        printf "%d of %d refusals reached\n", seen, refusals
    }' | sort -V >"$dir/all"
grep '^missed\|^refusal' "$dir/all" >"$dir/missed"
sed -n 's/^folder //p' "$dir/all"
sed -n 's/^file //p' "$dir/all" | awk '$2 < 0.95 * $4'
tail=$(grep 'branches taken' "$dir/all")
echo "$tail"
echo "$tail" | awk -F'[(%]' '{ exit !($2 >= 95) }'
