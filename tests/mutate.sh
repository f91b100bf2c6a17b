#!/bin/sh
# Called by `make mutate`: how many small errors in the library the C++ tests find. Each mutant differs from the library
# in one operator or one word of one source file; MUTANTS of these are drawn by SEED. Only that file is compiled; a mutant
# that compiles to the same instructions is none. A mutant is caught if a check fails or the program crashes: in the tests
# of its file, of its room, in random problems, or in the tests of rooms that may use it. Processor time is limited to five times what the
# library itself takes; a mutant that needs more is mostly an endless loop, and is counted apart. Those that survive are
# listed with the reason that tests/mutants.txt gives for the line; the last line counts. At least 95 % of the mutants
# that end must be caught or have a reason. FILES='src/safe/*.cpp': of these files. LIMIT=3600: seconds after which no
# further mutant is begun; the next run goes on from there, as build/mutants remembers what became of each mutant of an
# unchanged file (of those that survive, as long as the tests are the same, too).
: "${MAKE:=make}" "${BUILD:=build}" "${CXX:=c++}" "${MUTANTS:=200}" "${SEED:=1}" "${LIMIT:=1000000}"
dir=$BUILD/mutants
known=tests/mutants.txt
mkdir -p "$dir"
list=$dir/list.$SEED
: "${FILES:=$(ls src/*/*.cpp c_api/*.cpp)}"

# One line for each possible mutant: file, number of the line, column, what stands there, what comes instead, the line.
candidates() {
    awk '
    function mutant(at, from, to) { printf "%s\t%d\t%d\t%s\t%s\t%s\n", FILENAME, FNR, at, from, to, $0 }
    function find(from, to,   start, at) {
        for (start = 1; (at = index(substr(text, start), from)) > 0; start = start + at) mutant(start + at - 1, from, to)
    }
    {
        text = $0
        while (match(text, /"([^"\\]|\\.)*"/))   # what is in quotes stays
            text = substr(text, 1, RSTART - 1) sprintf("%*s", RLENGTH, "") substr(text, RSTART + RLENGTH)
        if (match(text, /\/\//)) text = substr(text, 1, RSTART - 1)
        if (text ~ /^ *(#|template|using|static_assert)/ || text ~ /^[^ ].*operator/) next
        if (text ~ /prefetch/) next   # changes no result
        find(" < ", " <= "); find(" <= ", " < "); find(" > ", " >= "); find(" >= ", " > ")
        find(" == ", " != "); find(" != ", " == "); find(" && ", " || "); find(" || ", " && ")
        find(" + ", " - "); find(" - ", " + "); find(" * ", " / "); find(" / ", " * ")
        find(" += ", " -= "); find(" -= ", " += "); find("++", "--")
        find("if (!", "if ("); find("larger(", "smaller("); find("smaller(", "larger(")
        find("true", "false"); find("false", "true"); find(" + 1", " + 2"); find(" - 1", " - 2")
        if (match(text, /if \([a-z(]/)) mutant(RSTART, "if (", "if (!")
        if (match(text, /(continue|break);/)) mutant(RSTART, substr(text, RSTART, RLENGTH), ";")
        if (text ~ /^        *[a-z_.]+\([^=]*\);$/ && text !~ /return|HARMORPH_TRY/) {
            first = substr(text, match(text, /[a-z]/), 1)
            mutant(RSTART, first, "if (false) " first)
        }
    }' $FILES
}
# Drawn by a hash of the file's name, the text of the line and the change: an edit elsewhere does not change what is drawn.
candidates | LC_ALL=C awk -F'\t' -v seed="$SEED" '
    BEGIN { for (k = 1; k < 256; ++k) code[sprintf("%c", k)] = k }
    {
        hash = 1 + seed * 1000003 % 2147483647
        key = $1 " " $3 " " $4 $5 " " $6
        for (k = 1; k <= length(key); ++k) hash = (hash * 65599 + code[substr(key, k, 1)]) % 2147483647
        for (k = 0; k < 4; ++k) hash = hash * 48271 % 2147483647
        printf "%d\t%s\n", hash, $0
    }' | sort -n | head -n "$MUTANTS" | cut -f 2-6 >"$list"

# The tests and the random problems themselves, and the flags of the core, as make has them.
$MAKE -s BUILD="$BUILD" JOBS="${JOBS:-2}" all fuzzer tests-only || exit 1
flags="-O1 -std=c++17 -fno-exceptions -fno-rtti -fno-math-errno -ffp-contract=off -fno-threadsafe-statics -fPIC"
flags="$flags -w -Iinclude -Isrc -Ic_api"
compile() {   # source: what stands in `mutant.cpp`, so that names in objects are equal
    $CXX $flags -I"$(dirname "$1")" -c -o "$dir/mutant.o" "$dir/mutant.cpp" 2>/dev/null
}
link_tests() {   # object of the mutant, or nothing
    $CXX -pthread -o "$dir/tests" $(cat "$BUILD/objects/tests.list") $1 "$BUILD/libharmorph.a"
}
link_fuzzer() {
    $CXX -pthread -o "$dir/fuzzer" "$BUILD"/objects/fuzz/*.o $1 \
        $(cat "$BUILD/objects/program.list") "$BUILD/libharmorph.a"
}
# What may find a mutant, the likeliest first. Of other rooms, those below in the table of src/README.md: the rest cannot
# know of the file, but through the C interface, whose tests are among them.
rooms="$(sed -n 's/^| `\([a-z]*\)` |.*/\1/p' src/README.md) c_api"
rooms_below() {   # room: of the C interface, all
    seen=no
    for below in $rooms; do
        if [ "$1" = c_api ] && [ $below != c_api ] || [ "$seen" = yes ]; then echo $below; fi
        if [ $below = "$1" ]; then seen=yes; fi
    done
}
step() {   # which, folder of the programs, room, file
    case $1 in
    file) timeout 7200 "$2/tests" -aa=1 -sf="*tests/$3/test_$4.cpp" ;;
    room) timeout 7200 "$2/tests" -aa=1 -sf="*tests/$3/*" ;;
    others)
        filter=$(rooms_below "$3" | sed 's,.*,*tests/&/*,' | tr '\n' ',')
        if [ -n "$filter" ]; then timeout 7200 "$2/tests" -aa=1 -sf="$filter"; fi ;;
    random)
        for run in "problem 1000" "basis 1000" "sequence 1000" "polygons 600" "given 600" "parts 400" "plane 400" \
            "shape 600"; do
            timeout 7200 "$2/fuzzer" $run 1 || return
        done ;;
    esac
}
# Seconds of processor time that a step may take: five times what it takes without a mutant, where nothing may fail. The
# tests of a file may take as long as those of the room.
limit() {   # which, room
    case $1 in
    file) limit room "$2" ;;
    others)
        sum=0
        for below in $(rooms_below "$2"); do sum=$((sum + $(limit room $below))) || exit 1; done
        echo $sum ;;
    *)
        limits=$dir/limit.$1
        if [ "$1" = room ]; then limits=$limits.$2; fi
        if [ -z "$(find "$limits" -newer "$BUILD/tests" -newer "$BUILD/fuzzer" 2>/dev/null)" ]; then
            (step "$1" "$BUILD" "$2" >"$dir/out" 2>&1 && times) >"$dir/times" ||
                { echo "the tests fail without a mutant: $1 $2" >&2; cat "$dir/out" >&2; exit 1; }
            awk -F'[ms ]+' 'NR == 2 { print 5 + int(5 * (60 * $1 + $2 + 60 * $3 + $4)) }' "$dir/times" >"$limits"
        fi
        cat "$limits" ;;
    esac
}
# What becomes of the mutant in a step: "caught", "out of time", or nothing. What waits for ever without using the
# processor is out of time after two hours by the clock.
outcome() {   # which, room, file
    seconds=$(limit "$1" "$2") || exit 1
    (
        ulimit -v 8000000
        ulimit -t "$seconds"
        step "$1" "$dir" "$2" "$3"
    ) >"$dir/out" 2>&1
    case $? in
    0) ;;
    124 | 137 | 152) echo "out of time" ;;   # timeout's own code, SIGKILL, SIGXCPU
    *) echo caught ;;
    esac
}
fate() {   # file line column from to steps otherwise: what becomes of the mutant
    original=$dir/$(echo "$1" | tr / -).$(cksum <"$1" | tr ' ' -).o
    if [ ! -e "$original" ]; then
        cp "$1" "$dir/mutant.cpp"
        compile "$1" && mv "$dir/mutant.o" "$original" || exit 1
    fi
    awk -v line="$2" -v column="$3" -v from="$4" -v to="$5" '
        NR == line { $0 = substr($0, 1, column - 1) to substr($0, column + length(from)) } { print }' "$1" >"$dir/mutant.cpp"
    compile "$1" || { echo "no C++"; return; }
    if cmp -s "$dir/mutant.o" "$original"; then echo "the same instructions"; return; fi
    room=$(basename "$(dirname "$1")") file=$(basename "$1" .cpp)
    found=
    for which in $6; do
        case $which in
        file | others) link_tests "$dir/mutant.o" || exit 1 ;;
        random) link_fuzzer "$dir/mutant.o" || exit 1 ;;
        esac
        if [ $which = file ] && ! [ -e "tests/$room/test_$file.cpp" ]; then continue; fi
        found=$(outcome $which "$room" "$file") || exit 1
        if [ -n "$found" ]; then break; fi
    done
    echo "${found:-$7}"
}

remembered=$dir/fates
touch "$remembered"
begun=$(date +%s)
tests=$(cat tests/*/test_*.cpp tests/fixtures/*.hpp tests/fuzz/*.cpp | cksum | tr ' ' -)
caught=0 endless=0 explained=0 survived=0 built=0 left=0
remember() {   # what became of $mutant, if that is known; of survivors, with these tests
    known_fate=$(awk -F'\t' -v mutant="$mutant" -v tests="$tests" '
        index($0, mutant "\t") == 1 && ($(NF - 1) !~ /survives|hidden/ || $NF == tests) { fate = $(NF - 1) }
        END { print fate }' "$remembered")
}
# In two rounds, as other rooms take long: who is hidden after the first is judged by them in the second.
for round in "file room random:hidden" "others:survives"; do
    while IFS='	' read -r file line column from to; do
        mutant="$file	$(cksum <"$file")	$line	$column	$from	$to"
        remember
        case "$round $known_fate" in
        "file room random:hidden " | "others:survives hidden") ;;
        *) continue ;;
        esac
        if [ $(($(date +%s) - begun)) -ge "$LIMIT" ]; then continue; fi
        known_fate=$(fate "$file" "$line" "$column" "$from" "$to" "${round%:*}" "${round#*:}") || exit 1
        printf '%s\t%s\t%s\n' "$mutant" "$known_fate" "$tests" >>"$remembered"
    done <"$list"
done
while IFS='	' read -r file line column from to; do
    mutant="$file	$(cksum <"$file")	$line	$column	$from	$to"
    remember
    case $known_fate in
    "" | hidden) left=$((left + 1)) ;;
    caught) built=$((built + 1)) caught=$((caught + 1)) ;;
    "out of time") built=$((built + 1)) endless=$((endless + 1)); echo "out of time: $file:$line: '$from' becomes '$to'" ;;
    survives)
        built=$((built + 1))
        text=$(sed -n "${line}s/^ *//p" "$file")
        reason=$(awk -F'\t' -v file="$file" -v text="$text" -v change="$from>$to" '
            $1 == file && index(text, $2) && $3 == change { print $4; exit }' "$known")
        if [ -n "$reason" ]; then explained=$((explained + 1)); else survived=$((survived + 1)); fi
        echo "survives: $file:$line: '$from' becomes '$to'"
        echo "    $text"
        echo "    ${reason:-not explained}" ;;
    esac
done <"$list"
if [ $left -gt 0 ]; then echo "$left mutants of this list have not been judged"; fi
echo "$built mutants: $caught caught, $endless out of time, $explained survive with a reason, $survived without one"
[ $((100 * (caught + explained))) -ge $((95 * (built - endless))) ]
