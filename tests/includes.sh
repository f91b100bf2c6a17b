#!/bin/sh
# Includes point only downwards. The rooms of the core, bottom to top: a file may include what is in a room below, or in
# its own room; within a room headers include each other without a circle. The folder of a file is its room.
rooms='base simd mesh space bspline boundary dense ordering basis operators parts direct multigrid plan morph safe'
rooms="$rooms fields"
# The core may use those parts of the standard library that a freestanding compiler has, and mem*.
freestanding='cstddef|cstdint|cfloat|climits|limits|type_traits|new|cstring|cpuid\.h|immintrin\.h|arm_neon\.h'
freestanding="$freestanding|wasm_simd128\.h"

topic=includes
. "$(dirname "$0")/count.sh"
included() { sed -n 's|^ *# *include *[<"]\([^>"]*\)[>"].*|\1|p' "$1"; }
floor() {   # the height of a room; nothing if there is no such room
    echo "$rooms" | awk -v name="$1" '{ for (k = 1; k <= NF; ++k) if ($k == name) print k }'
}

pairs=$(mktemp)
trap 'rm -f "$pairs"' EXIT
for file in src/* src/*/*; do
    [ -f "$file" ] || continue
    case $file in *.md) continue ;; esac
    room=$(basename "$(dirname "$file")") here=$(floor "$(basename "$(dirname "$file")")")
    if [ -z "$here" ]; then is_empty "$file" "is in no room of tests/includes.sh"; continue; fi
    wrong=
    for name in $(included "$file"); do
        case $name in
        */*.hpp)
            there=$(floor "${name%/*}") header=src/$name ;;
        *)
            if ! echo "$name" | grep -qxE "$freestanding"; then wrong="$wrong $name"; fi
            continue ;;
        esac
        if [ -z "$there" ] || [ "$there" -gt "$here" ] || [ ! -f "$header" ]; then wrong="$wrong $name"; fi
        echo "$file $header" >>"$pairs"
    done
    is_empty "$file" "$wrong"
done
# tsort names the files of a circle.
top=$(git ls-files 2>/dev/null | cut -d/ -f1 | sort -u | grep -vxE \
    'CMakeLists.txt|LICENSE|Makefile|README.md|c_api|fortran|include|src|tests|\.[a-z-]+')
is_empty "files of the top level that do not belong there" "$top"
is_empty "circles" "$(tsort "$pairs" 2>&1 >/dev/null)"

# The table of rooms in src/README.md is this list.
described=$(sed -n 's/^| `\([a-z]*\)` |.*/\1/p' src/README.md | head -n "$(echo "$rooms" | wc -w)" | tr '\n' ' ')
is_empty src/README.md "$([ "$described" = "$rooms " ] || echo "has other rooms: $described")"

# Files and names that the page names exist.
exists() {   # a path from the top, from a folder of sources, or without what follows the dot
    for from in "" src/ c_api/ c_api/cli/ tests/ fortran/; do
        if [ -e "$from$1" ] || [ -e "$from$1.hpp" ] || [ -e "$from$1.cpp" ]; then return 0; fi
    done
    return 1
}
is_empty "pages of src name what does not exist" "$(awk -f tests/named.awk src/*.md | sort -u |
    while read -r kind name; do
        case $kind in
        file) exists "$name" || echo "$name" ;;
        word) grep -rqw --include='*.[ch]pp' --include='*.[ch]' --include='*.in' --include='*.sh' -e "$name" \
            src c_api include fortran tests || grep -qw -e "$name" Makefile \
            || ls -d src/*/"$name" src/"$name" c_api/*/"$name" "$name" \
            >/dev/null 2>&1 || echo "$name" ;;
        esac
    done)"

# Tests lie in the rooms of what they test. The page of tests says of each folder what it proves, and `make test`
# refuses to run a folder that does not exist.
is_empty "folders without a row in tests/README.md" "$(for folder in tests/*/; do
        folder=$(basename "$folder")
        grep -q "^|.*\`$folder\`.*|.*|$" tests/README.md || echo "$folder"
    done)"
is_empty "files of tests that lie in no folder" "$(git ls-files tests 2>/dev/null | grep -v '/.*/' | grep -vxE \
    'tests/(README\.md|run\.sh|(main|reach)\.cpp|(count|includes|needs|only|tidy)\.sh|named\.awk)')"
is_empty "make test ONLY=no_such_folder" "$(ONLY=no_such_folder sh tests/run.sh | tr '\n' ' ' | grep -v \
    '^ONLY=no_such_folder: there is no such .* base .* formats .* web .*0 passed, 1 failed $')"
for directory in tests/*/; do
    room=$(basename "$directory")
    ls "$directory" | grep -q '^test_' || continue
    case $room in c_api | fixtures) continue ;; esac
    is_empty "$directory" "$([ -n "$(floor "$room")" ] || echo "is no room of the core")"
done

# The program is a client of the C headers alone: its files include headers of its own rooms, and installed ones. The
# rooms of the program, bottom to top: its page has the same list.
rooms='basics files options mesh formats curves work pictures page sampling commands'
for file in c_api/cli/*/*.[ch]pp; do
    here=$(floor "$(basename "$(dirname "$file")")") wrong=
    for name in $(included "$file" | grep '/' | grep -v '^sys/'); do
        there=$(floor "${name%/*}")
        if [ -z "$there" ] || [ "$there" -gt "$here" ] || [ ! -f "c_api/cli/$name" ]; then wrong="$wrong $name"; fi
    done
    is_empty "$file" "$wrong"
done
# A header of the project that has no room of the program is one of include/, which `make install` installs. The program
# and its pages call what these headers declare.
not_installed() {   # headers that the program includes, one a line
    grep '\.' | while read -r name; do
        if [ -f "include/$name" ] || [ -f "c_api/cli/$name" ]; then continue; fi
        [ -z "$(find src c_api fortran -name "${name##*/}")" ] || echo "$name"
    done
}
is_empty "headers of the program that are not installed" "$(cat c_api/cli/main.cpp c_api/cli/*/*.[ch]pp |
    included /dev/stdin | sort -u | not_installed)"
is_empty "private calls of the program" \
    "$(grep -noE 'hm_(private|web)_[a-z_]*' c_api/cli/main.cpp c_api/cli/*/*.[ch]pp c_api/cli/page/*.js)"
is_empty "a private header that is not found" "$(
    for name in mesh_pair.hpp c_api/private.h morph/quality.hpp; do
        [ "$(echo $name | not_installed)" = $name ] || echo "$name"
    done)"
# Only the room of files asks the system, so that the others can be compiled where there is none.
is_empty "files outside of c_api/cli/files that include what the system has" "$(grep -lE \
    '#include <(filesystem|thread|mutex|condition_variable|atomic|future|pthread|csignal|fcntl|sys/)' \
    $(ls c_api/cli/*/*.[ch]pp | grep -v '^c_api/cli/files/'))"
# Files appear by files/output_file alone: all outputs of a command together, or none. (CGNS has a library of its own;
# own_folder has a lock.) Numbers become text, and text becomes numbers, in basics alone.
is_empty "files that write past files/output_file" "$(grep -lE \
    'std::(ofstream|fstream|rename|fopen|fwrite)|[^_a-z](fopen|mkstemp|O_CREAT)' c_api/cli/*/*.[ch]pp |
    grep -vxE 'c_api/cli/files/(output_file\.[ch]pp|own_folder\.cpp|paths\.cpp)')"
is_empty "conversions between numbers and text outside of basics" "$(grep -nE \
    '(from|to)_chars|std::(ato[ifl]|ato[l]+|sto[dfil]|sto[ul]+|strto[a-z]+|v?s?n?printf|sscanf|setprecision)\b' \
    $(ls c_api/cli/*/*.[ch]pp | grep -v '^c_api/cli/basics/'))"
# Results of the C library differ in the last digit from one system to another; those in pictures may.
is_empty "functions of the C library instead of those of basics/elementary.hpp" "$(grep -nE \
    'std::(a?(sin|cos|tan)h?|atan2|exp[2m]?1?|log[12]?[0p]?|pow|hypot|[lt]gamma|erfc?|cbrt)\(' \
    $(ls c_api/cli/*/*.[ch]pp | grep -v '^c_api/cli/pictures/'))"
# The page lists the files that a movement passes: they exist, and each is included by another one of them.
on_the_way=$(sed -n '/^A line of a file of movements passes/,/^$/p' c_api/cli/README.md |
    grep -o '`[a-z]*[/.][a-z_]*`' | tr -d '`' | sed 's/^main\.cpp$/main/')
not_reached() {
    if [ "$(echo "$on_the_way" | wc -l)" -gt 12 ]; then echo "there are more than 12"; fi
    for file in $on_the_way; do
        header=$file.hpp
        case $file in
        main) continue ;;
        formats/*) header=formats/format.hpp ;;
        commands/cmd_*) header=commands/commands.hpp ;;
        esac
        others=$(for other in $on_the_way; do
            if [ "$other" != "$file" ]; then ls c_api/cli/"$other".?pp; fi
        done)
        if [ ! -f "c_api/cli/$file.cpp" ]; then echo "$file does not exist"; fi
        grep -qF "#include \"$header\"" $others || echo "$file is not reached"
    done
}
is_empty "files that a movement passes" "$(not_reached)"
described=$(sed -n '/^## The sources/,$s/^| `\([a-z]*\)` |.*/\1/p' c_api/cli/README.md | tr '\n' ' ')
is_empty c_api/cli/README.md "$([ "$described" = "$rooms " ] || echo "has other rooms: $described")"

# All that the program says goes through c_api/cli/basics/print.hpp, which makes any bytes readable. Each option whose
# value names a file says what the command does with the file, so that no output replaces an input.
is_empty "the program prints past basics/print.hpp" \
    "$(grep -nE 'std::(printf|puts|cout|cerr|vprintf)' c_api/cli/main.cpp c_api/cli/*/*.[ch]pp)"
is_empty "options for files without the use of the file" "$(awk '
    FNR == 1 { begun = /^Options:$/ } /^Options:$/ { begun = 1 }
    begun && /^-.* .*(FILE|MESH|BASIS|CURVE|MOVES|MAP|DAT|FIELD|FLUXES|LIST|TABLE|VALUES|PAGE|csv)/ &&
        !/  \((mesh|input|output|moved mesh)/ { print FILENAME ": " $0 }' c_api/cli/commands/*.txt)"

# One word for one thing: include/README.md says which; the core rotates, too. Terms of other fields that contain such a
# word are allowed. Each check is tried on lines that it has to find.
banned='buffer|deform(ations?|ed|s)?|elements?|facets?|grids?|mode shapes?|nodes?|patch(es)?|poles?|profiles?'
banned="$banned|scratch|sensitivit(y|ies)|tags?|turn(s|ed|ing)?|vert(ex|ices)|workspace|work_bytes|zones?"
allowed='free-form deformation|hanging nodes?|the node i, j|of the node|major\.minor\.patch|pthreads_turns'
allowed="$allowed|others deform"
allowed="$allowed|turned inside out|in turn|turn threads on|int32_t turn|turn = 0|turn <|\+\+turn"
other_words() { grep -HniE "(^|[^a-z_])($banned)([^a-z_]|\$)" "$@" | grep -viE "$allowed"; }
other_rotations() {
    grep -rHnE '(^|[^A-Za-z])([Tt]urn(s|ed|)|unturned)([^a-z]|$)' "$@" |
        grep -vE 'in turn([^a-z]|$)|turn(s|ed) inside out'
}
is_empty "headers have other words than include/README.md" "$(other_words include/*.h)"
is_empty "the core does not rotate" "$(other_rotations src c_api/*.cpp c_api/*.hpp)"
is_empty "other words that are not found" "$(
    echo '/* the vertex of a grid */' | other_words - >/dev/null || echo vertex
    for line in 'Vec2 turn_of(Mesh const& mesh);' 'struct TurnAt {' '// The body is turned.' 'bool is_turned();'; do
        echo "$line" | other_rotations - >/dev/null || echo "$line"
    done)"

# C and C++ have at most 100 columns, laid out as .clang-format has it; Fortran, Python and scripts 120.
too_wide() {   # columns, names of files
    columns=$1; shift
    find c_api fortran include src tests -type f \( "$@" \) -exec awk -v most="$columns" '
        length($0) > most { print FILENAME ":" FNR; if (++n > 20) exit }' {} +
}
is_empty "lines of more than 100 columns" "$(too_wide 100 -name '*.[ch]pp' -o -name '*.[ch]')"
is_empty "lines of more than 120 columns" \
    "$(too_wide 120 -name '*.sh' -o -path 'c_api/python/*.py' -o -name '*.f90' -o -name '*.f90.in' -o -name '*.f')"
# Other versions of clang-format lay out some lines in another way.
case $(clang-format --version 2>/dev/null) in
*" version 14."*)
    is_empty "files that clang-format would change" "$(find c_api include src tests \
        \( -name '*.cpp' -o -name '*.hpp' -o -name '*.[ch]' \) -exec \
        clang-format --dry-run {} + 2>&1 | sed -n 's/^\([^:]*\):.*warning: .*/\1/p' | sort -u)" ;;
*) skip "the layout of the sources" "clang-format of version 14 (Debian 12) is not installed" ;;
esac

# The files of the top folder; files that a test leaves there could be committed by mistake.
if tracked=$(git ls-files 2>/dev/null); then
    is_empty "the top of the sources" "$(echo "$tracked" | sed 's|/.*||' | sort -u |
        grep -vxE 'Makefile|CMakeLists\.txt|include|src|c_api|fortran|tests|README\.md|LICENSE|\..*')"
fi
finish
