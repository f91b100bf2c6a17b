#!/bin/sh
# Called by `make mutate`: how many small errors in the library the C++ tests find. Each mutant differs from the library
# in one operator or one word of one source file; MUTANTS of these are drawn by SEED. Only that file is compiled; a mutant
# that compiles to the same instructions is none. A mutant is caught if a test of its room fails, or a random problem, or
# any test. Those that survive are listed with the reason that tests/mutants.txt gives for the line; the last line
# counts. FILES='src/safe/*.cpp': of these files. LIMIT=3600: seconds after which no further mutant is begun; the next
# run with this seed goes on from there, as build/mutants remembers what became of each mutant of an unchanged file.
: "${MAKE:=make}" "${BUILD:=build}" "${CXX:=c++}" "${MUTANTS:=200}" "${SEED:=1}" "${LIMIT:=1000000}"
dir=$BUILD/mutants
known=tests/mutants.txt
mkdir -p "$dir"
list=$dir/list.$SEED
: "${FILES:=$(ls src/*/*.cpp c_api/*.cpp)}"

# One line for each possible mutant: file, number of the line, column, what stands there, what comes instead.
candidates() {
    awk '
    function mutant(at, from, to) { printf "%s\t%d\t%d\t%s\t%s\n", FILENAME, FNR, at, from, to }
    function find(from, to,   start, at) {
        for (start = 1; (at = index(substr(text, start), from)) > 0; start = start + at) mutant(start + at - 1, from, to)
    }
    FNR == 1 { inside_sentence = 0 }
    {
        text = $0
        while (match(text, /"([^"\\]|\\.)*"/))   # what is in quotes stays
            text = substr(text, 1, RSTART - 1) sprintf("%*s", RLENGTH, "") substr(text, RSTART + RLENGTH)
        if (match(text, /\/\//)) text = substr(text, 1, RSTART - 1)
        if (text ~ /^ *(#|template|using|static_assert)/ || text ~ /^[^ ].*operator/) next
        find(" < ", " <= "); find(" <= ", " < "); find(" > ", " >= "); find(" >= ", " > ")
        find(" == ", " != "); find(" != ", " == "); find(" && ", " || "); find(" || ", " && ")
        find(" + ", " - "); find(" - ", " + "); find(" * ", " / "); find(" / ", " * ")
        find(" += ", " -= "); find(" -= ", " += "); find("++", "--")
        find("if (!", "if ("); find("larger(", "smaller("); find("smaller(", "larger(")
        find("true", "false"); find("false", "true"); find(" + 1", " + 2"); find(" - 1", " - 2")
        if (match(text, /if \([a-z(]/)) mutant(RSTART, "if (", "if (!")
        if (match(text, /(continue|break);/)) mutant(RSTART, substr(text, RSTART, RLENGTH), ";")
        if (text ~ /^        *[a-z_.]+\([^=]*\);$/ && text !~ /return|HARMORPH_TRY/) mutant(match(text, /[a-z]/), "", "if (false) ")
    }' $FILES
}
candidates | awk -v seed="$SEED" -v n="$MUTANTS" '
    { line[NR] = $0 }
    END {
        srand(seed)
        for (k = 1; k <= n && k <= NR; ++k) {
            other = k + int(rand() * (NR - k + 1))
            its = line[other]; line[other] = line[k]; line[k] = its
            print its
        }
    }' >"$list"

# The tests and the random problems themselves, and the flags of the core, as make has them.
$MAKE -s BUILD="$BUILD" all fuzzer tests-only || exit 1
flags="-O1 -std=c++17 -fno-exceptions -fno-rtti -fno-math-errno -ffp-contract=off -fno-threadsafe-statics -fPIC"
flags="$flags -w -Iinclude -Isrc -Ic_api"
finds() {   # command with its words: does it fail on the mutant?
    ! (
        ulimit -v 8000000
        timeout 300 "$@"
    ) >"$dir/out" 2>&1
}
compile() {   # source: what stands in `mutant.cpp`, so that names in objects are equal
    $CXX $flags -I"$(dirname "$1")" -c -o "$dir/mutant.o" "$dir/mutant.cpp" 2>/dev/null
}
link() {
    $CXX -pthread -o "$dir/tests" "$BUILD"/objects/unit/*.o "$dir/mutant.o" "$BUILD/libharmorph.a" &&
        $CXX -pthread -o "$dir/fuzzer" "$BUILD"/objects/fuzz/*.o "$dir/mutant.o" \
            $(ls "$BUILD"/objects/cli/*.o | grep -v -e 'cli-main\.o' -e 'tests-deform') "$BUILD/libharmorph.a"
}
fate() {   # file line column from to: what becomes of the mutant
    original=$dir/$(echo "$1" | tr / -).$(cksum <"$1" | tr ' ' -).o
    if [ ! -e "$original" ]; then
        cp "$1" "$dir/mutant.cpp"
        compile "$1" && mv "$dir/mutant.o" "$original" || exit 1
    fi
    awk -v line="$2" -v column="$3" -v from="$4" -v to="$5" '
        NR == line { $0 = substr($0, 1, column - 1) to substr($0, column + length(from)) } { print }' "$1" >"$dir/mutant.cpp"
    compile "$1" || { echo "no C++"; return; }
    if cmp -s "$dir/mutant.o" "$original"; then echo "the same instructions"; return; fi
    link >/dev/null || exit 1
    room=$(basename "$(dirname "$1")")
    if finds "$dir/tests" -aa=1 -sf="*tests/$room/*" || finds "$dir/fuzzer" problem 400 1 ||
        finds "$dir/tests" -aa=1 -sfe="*tests/$room/*"; then
        echo caught
    else
        echo survives
    fi
}

remembered=$dir/fates
touch "$remembered"
begun=$(date +%s)
caught=0 explained=0 survived=0 built=0
while IFS='	' read -r file line column from to; do
    mutant="$file	$(cksum <"$file")	$line	$column	$from	$to"
    known_fate=$(awk -v mutant="$mutant" 'index($0, mutant "\t") == 1 { sub(/.*\t/, ""); print; exit }' "$remembered")
    if [ -z "$known_fate" ]; then
        if [ $(($(date +%s) - begun)) -ge "$LIMIT" ]; then continue; fi
        known_fate=$(fate "$file" "$line" "$column" "$from" "$to") || exit 1
        printf '%s\t%s\n' "$mutant" "$known_fate" >>"$remembered"
    fi
    case $known_fate in
    caught) built=$((built + 1)) caught=$((caught + 1)) ;;
    survives)
        built=$((built + 1))
        text=$(sed -n "${line}s/^ *//p" "$file")
        reason=$(awk -F'\t' -v file="$file" -v text="$text" '$1 == file && index(text, $2) { print $3; exit }' "$known")
        if [ -n "$reason" ]; then explained=$((explained + 1)); else survived=$((survived + 1)); fi
        echo "survives: $file:$line: '$from' becomes '$to'"
        echo "    $text"
        echo "    ${reason:-not explained}" ;;
    esac
done <"$list"
echo "$built mutants: $caught caught, $explained survive with a reason, $survived without one"
[ $((100 * (caught + explained))) -ge $((95 * built)) ]
