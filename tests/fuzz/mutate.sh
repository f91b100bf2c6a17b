#!/bin/sh
# Called by `make mutate`: how many small errors in the library the C++ tests find. Each mutant differs from the library
# in one operator or one word of one source file; MUTANTS of these are drawn by SEED. Only that file is compiled; a
# mutant that compiles to the same instructions is none. Each is judged by all test cases that enter the function of the
# mutant, which one run with a library that notes its functions has told (tests/reach.cpp): the quick ones of its folder
# first, then those of other folders, then the slow ones. A line outside of functions, and one whose function no case
# enters, is judged by all cases. A mutant is caught if a check fails, the program crashes, or the tests take more than
# three times the time that they take without it, which is an endless loop. Those that survive are listed with the
# reason that mutants.txt gives for the line; the last line counts. At least 90 % of the mutants that change the library
# in a way that tests can see must be caught. JOBS mutants are judged at a time. FILES='src/safe/*.cpp': of these files.
# CARRY=FILE: the mutants of this list (build/mutants/list.SEED of another state of the sources) at the lines where they
# are now, instead of those drawn. LIMIT=3600: seconds after which no further mutant is begun; the next run goes on from
# there, as build/mutants remembers what became of each mutant of an unchanged file (of those that survive, as long as
# the tests are the same, too). REACH=FOLDER: build/mutants/reach of an earlier run, which says what cases enter; cases
# that it does not name are taken to enter every function.
: "${MAKE:=make}" "${BUILD:=build}" "${CXX:=c++}" "${MUTANTS:=200}" "${SEED:=1}" "${LIMIT:=1000000}" "${JOBS:=2}"
: "${CARRY=}" "${REACH=}"
dir=$BUILD/mutants
known=tests/fuzz/mutants.txt
mkdir -p "$dir"
list=$dir/list.$SEED
: "${FILES:=$(ls src/*/*.cpp c_api/*.cpp)}"

# One line for each possible mutant: file, number of the line, column, what stands there, what comes instead, the line.
candidates() {
    awk '
    function mutant(at, from, to) { printf "%s\t%d\t%d\t%s\t%s\t%s\n", FILENAME, FNR, at, from, to, $0 }
    function find(from, to,   start, at) {
        for (start = 1; (at = index(substr(text, start), from)) > 0; start = start + at)
            mutant(start + at - 1, from, to)
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
        find("if (!", "if ("); find("max(", "min("); find("min(", "max(")
        find("true", "false"); find("false", "true"); find(" + 1", " + 2"); find(" - 1", " - 2")
        if (match(text, /if \([a-z(]/)) mutant(RSTART, "if (", "if (!")
        if (match(text, /(continue|break);/)) mutant(RSTART, substr(text, RSTART, RLENGTH), ";")
        if (text ~ /^        *[a-z_.]+\([^=]*\);$/ && text !~ /return|HARMORPH_TRY/) {
            first = substr(text, match(text, /[a-z]/), 1)
            mutant(RSTART, first, "if (false) " first)
        }
    }' $FILES
}
# Drawn by a hash of the file's name, the text of the line and the change:
# an edit elsewhere does not change what is drawn.
candidates | LC_ALL=C awk -F'\t' -v seed="$SEED" '
    BEGIN { for (k = 1; k < 256; ++k) code[sprintf("%c", k)] = k }
    {
        hash = 1 + seed * 1000003 % 2147483647
        key = $1 " " $3 " " $4 $5 " " $6
        for (k = 1; k <= length(key); ++k) hash = (hash * 65599 + code[substr(key, k, 1)]) % 2147483647
        for (k = 0; k < 4; ++k) hash = hash * 48271 % 2147483647
        printf "%d\t%s\n", hash, $0
    }' | sort -n | head -n "$MUTANTS" | cut -f 2- >"$list.drawn"
# Where the mutants of another list are now: of equal lines, the one that is nearest to where it was. Lines that no
# longer exist are named.
carried() {
    while IFS='	' read -r file line column from to text; do
        now=$(LC_ALL=C awk -v was="$line" -v text="$(printf '%s' "$text" | sed 's/\\/\\\\/g')" '
            $0 == text {
                away = FNR > was ? FNR - was : was - FNR
                if (!best || away < least) { best = FNR; least = away }
            }
            END { print best + 0 }' "$file" 2>/dev/null)
        if [ "${now:-0}" = 0 ]; then echo "gone: $file:$line: '$from' becomes '$to': $text" >&2; continue; fi
        printf '%s\t%s\t%s\t%s\t%s\t%s\n' "$file" "$now" "$column" "$from" "$to" "$text"
    done <"$CARRY"
}
if [ -n "$CARRY" ]; then
    list=$dir/list.carried
    carried >"$list.drawn"
fi
mv "$list.drawn" "$list"

# The tests themselves, and the flags of the core, as make has them.
$MAKE -s BUILD="$BUILD" JOBS="$JOBS" all meshes tests-only || exit 1
flags="-O1 -std=c++17 -fno-exceptions -fno-rtti -fno-math-errno -ffp-contract=off -fno-threadsafe-statics -fPIC"
flags="$flags -w -Iinclude -Isrc -Ic_api"
link="$CXX -pthread"
if echo 'int main() {}' | $link -fuse-ld=lld -x c++ -o "$dir/linked" - 2>/dev/null; then link="$link -fuse-ld=lld"; fi

compile() {   # source, folder: what stands in `mutant.cpp` there, so that names in objects are equal
    $CXX $flags -I"$(dirname "$1")" -c -o "$2/mutant.o" "$2/mutant.cpp" 2>/dev/null
}
link_tests() { $link -o "$1/tests" $(cat "$BUILD/objects/tests.list") "$1/mutant.o" "$BUILD/libharmorph.a"; }

# In $reach/cases the number, seconds, file and name of each test case; in $reach/entered the file and line of each
# function of the library that cases enter, whether it is within another one, and the numbers of these cases.
find_reach() {
    mkdir -p "$reach"
    watched="-finstrument-functions -finstrument-functions-exclude-file-list=.hpp,.h,/usr/"
    $MAKE -s BUILD="$reach" JOBS="$JOBS" CXXFLAGS="-O1 -g1 $watched" library-only || exit 1
    $CXX -std=c++17 -O1 -w -c -o "$reach/reach.o" tests/reach.cpp || exit 1
    $link -no-pie -o "$reach/tests" $(cat "$BUILD/objects/tests.list") "$reach/reach.o" "$reach/libharmorph.a" || exit 1
    HARMORPH_REACH=$reach/raw "$reach/tests" >"$reach/log" ||
        { cat "$reach/log"; echo "the tests fail without a mutant"; exit 1; }
    awk '/^case/ { print ++n substr($0, 5) }' "$reach/raw" >"$reach/cases"
    grep '^0x' "$reach/raw" | sort -u >"$reach/addresses"
    addr2line -C -f -e "$reach/tests" <"$reach/addresses" | paste - - | paste "$reach/addresses" - |
        sed "s|$PWD/||; s| (discriminator.*||; s|(anonymous namespace)|anonymous|g" |
        awk -F'\t' '
        FNR == NR {
            split($3, place, ":")
            inner[$1] = $2 ~ /\{lambda|\)::|const::/ ? 1 : 0
            at[$1] = place[1] "\t" place[2]
            next
        }
        $1 == "case" { ++number; next }
        { of[$1] = of[$1] " " number }
        END { for (address in of) print at[address] "\t" inner[address] "\t" of[address] }' - "$reach/raw" \
        >"$reach/entered"
}
reach=${REACH:-$dir/reach}
if [ -z "$REACH" ]; then find_reach; fi

# The cases that may find a mutant, into $share/near (quick ones of its folder), quick and slow: a list of patterns, in
# which a comma would begin another one. Into $share/limits the seconds of processor time that each list may take.
choose_cases() {   # folder of the share, room, file, line
    everywhere=0
    if sed -n "${4}p" "$3" | grep -q '^[^ ]\|constexpr'; then everywhere=1; fi
    "$BUILD/tests" -ltc | awk -F'\t' -v room="/$2/" -v file="$3" -v line="$4" -v all=$everywhere -v to="$1" '
        FILENAME ~ /entered$/ {
            if ($1 != file || $2 + 0 > line) next
            if (!$3 && $2 + 0 > outer) outer = $2 + 0
            start[++n] = $2 + 0
            cases[n] = $4
            next
        }
        FILENAME ~ /cases$/ { seconds[$4] = $2; source[$4] = $3; numbers[$4] = numbers[$4] " " $1; next }
        FNR == 1 {
            for (k = 1; k <= n; ++k) {
                if (start[k] < outer) continue
                many = split(cases[k], number, " ")
                for (j = 1; j <= many; ++j) enters[number[j]] = found = 1
            }
        }
        !/^\[doctest\]|^===/ {
            wanted = all || !found || !($0 in seconds)
            many = split(numbers[$0], number, " ")
            for (j = 1; j <= many; ++j) if (number[j] in enters) wanted = 1
            if (!wanted) next
            list = seconds[$0] > 0.5 ? "slow" : index(source[$0], room) ? "near" : "quick"
            limit[list] += 3 * seconds[$0]
            gsub(/,/, "?")
            names[list] = names[list] $0 ","
        }
        END {
            split("near quick slow", lists, " ")
            for (k = 1; k <= 3; ++k) {
                printf "%s", names[lists[k]] >(to "/" lists[k])
                print lists[k], 5 + int(limit[lists[k]]) >(to "/limits")
            }
        }' "$reach/entered" "$reach/cases" -
}
# Prints the result of a list of cases for the mutant: "caught", "out of time", or nothing.
outcome() {   # which, folder of the share
    [ -s "$2/$1" ] || return
    (
        ulimit -v 8000000
        ulimit -t $(sed -n "s/^$1 //p" "$2/limits")
        exec timeout 7200 "$2/tests" -aa=1 -tc="$(cat "$2/$1")"   # what waits for ever uses no processor time
    ) >"$2/out" 2>&1
    case $? in
    0) ;;
    124 | 137 | 152) echo "out of time" ;;   # timeout's own code, SIGKILL, SIGXCPU
    *) echo caught ;;
    esac
}
fate() {   # folder, file, line, column, from, to, steps, otherwise: what becomes of the mutant
    original=$1/$(echo "$2" | tr / -).$(cksum <"$2" | tr ' ' -).o
    if [ ! -e "$original" ]; then
        cp "$2" "$1/mutant.cpp"
        compile "$2" "$1" && mv "$1/mutant.o" "$original" || exit 1
    fi
    awk -v line="$3" -v column="$4" -v from="$5" -v to="$6" '
        NR == line { $0 = substr($0, 1, column - 1) to substr($0, column + length(from)) }
        { print }' "$2" >"$1/mutant.cpp"
    compile "$2" "$1" || { echo "no C++"; return; }
    if cmp -s "$1/mutant.o" "$original"; then echo "the same instructions"; return; fi
    choose_cases "$1" "$(basename "$(dirname "$2")")" "$2" "$3"
    link_tests "$1" || exit 1
    for which in $7; do
        found=$(outcome $which "$1")
        if [ -n "$found" ]; then echo "$found"; return; fi
    done
    echo "$8"
}

remembered=$dir/fates
touch "$remembered"
begun=$(date +%s)
tests=$(cat tests/*/test_*.cpp tests/fixtures/*.hpp | cksum | tr ' ' -)
remember() {   # what became of $mutant, if that is known; of survivors, with these tests
    known_fate=$(awk -F'\t' -v mutant="$mutant" -v tests="$tests" '
        index($0, mutant "\t") == 1 && ($(NF - 1) !~ /survives|hidden/ || $NF == tests) { fate = $(NF - 1) }
        END { print fate }' "$remembered")
}
# In two rounds, as slow cases take long: who is hidden after the first is judged by them in the second.
judge() {   # share of the list, from 0
    share=$dir/share.$1
    mkdir -p "$share"
    for round in "near quick:hidden" "slow:survives"; do
        number=0
        while IFS='	' read -r file line column from to text; do
            number=$((number + 1))
            if [ $((number % JOBS)) != "$1" ] || [ $(($(date +%s) - begun)) -ge "$LIMIT" ]; then continue; fi
            mutant="$file	$(cksum <"$file")	$line	$column	$from	$to"
            remember
            case "$round $known_fate" in
            "near quick:hidden " | "slow:survives hidden") ;;
            *) continue ;;
            esac
            known_fate=$(fate "$share" "$file" "$line" "$column" "$from" "$to" "${round%:*}" "${round#*:}") || exit 1
            printf '%s\t%s\t%s\n' "$mutant" "$known_fate" "$tests" >>"$remembered"
        done <"$list"
    done
}
share=0
while [ $share -lt "$JOBS" ]; do judge $share & share=$((share + 1)); done
wait

caught=0 endless=0 explained=0 survived=0 built=0 left=0
while IFS='	' read -r file line column from to text; do
    mutant="$file	$(cksum <"$file")	$line	$column	$from	$to"
    remember
    case $known_fate in
    "" | hidden) left=$((left + 1)) ;;
    caught) built=$((built + 1)) caught=$((caught + 1)) ;;
    "out of time")
        built=$((built + 1)) endless=$((endless + 1))
        echo "out of time: $file:$line: '$from' becomes '$to'" ;;
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
[ $((100 * (caught + endless))) -ge $((90 * (built - explained))) ]
