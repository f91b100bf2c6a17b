#!/bin/sh
# usage: run.sh BUILD   (FC, FFLAGS, CC, CFLAGS from the environment)
# The Fortran module and the legacy calls: compiled without a warning and with all run-time checks, those of the address
# sanitizer among them (not optimised, which would take most of the time), then optimised, with OpenMP and with default
# integers and reals of 8 bytes; each time all tests run.
: "${FC:=gfortran}" "${FFLAGS:=-O2}" "${CC:=cc}" "${CFLAGS:=-O2}"
build=$(cd "${1:?usage: run.sh BUILD}" && pwd)
dir=$build/fortran
rm -rf "$dir"
mkdir -p "$dir"
topic=Fortran log=$dir/log
. "$(dirname "$0")/../count.sh"
strict=-std=f2008 legacy= checks= long= address=
if $FC --version 2>/dev/null | grep -q '^GNU'; then
    strict="-std=f2008 -Wall -Wextra -Werror" legacy="-std=legacy -Wall -Wextra -Werror"
    checks="-fcheck=all,no-array-temps -ffpe-trap=invalid,zero,overflow"
    long="-fopenmp -fdefault-integer-8 -fdefault-real-8"
    address="-fsanitize=address -fno-omit-frame-pointer"
fi
if [ -n "$address" ]; then
    echo 'end' >"$dir/empty.f90"
    if $FC $address "$dir/empty.f90" -o "$dir/empty" 2>/dev/null && "$dir/empty"; then
        checks="$checks $address"
    else
        skip "the address sanitizer" "$FC has none"
    fi
fi
loose="-Wno-conversion -Wno-compare-reals"    # of the tests: numbers that must be equal
quietly() { "$@" 2>&1 | tee "$dir/warnings"; test ! -s "$dir/warnings"; }
# The modules that tests share come first, then the tests of each topic, then the program that calls them. Three files
# are programs of other tests, or shared with them.
shared="counts meshes body_mesh kept"
topics=$(ls tests/fortran | sed -n 's/\.f90$//p' | grep -vxE "use|layout|o_mesh|read_su2|$(echo $shared | tr ' ' '|')")
# The tests themselves are not optimised (of several levels the last one counts): that would take most of the time.
build_and_run() {   # where, flags...: its own modules and objects in each place
    place=$dir/$1; shift
    mkdir -p "$place"
    check "module with $*" quietly $FC $strict $FFLAGS "$@" -J"$place" -c "$build/harmorph.f90" -o "$place/harmorph.o"
    for test in $shared $topics use; do
        check "$test.f90 with $*" quietly $FC $strict $loose $FFLAGS "$@" -O0 -I"$place" -J"$place" \
            -c tests/fortran/$test.f90 -o "$place/$test.o"
    done
    check "link with $*" $FC $FFLAGS "$@" "$place"/*.o "$build/libharmorph.a" -o "$place/use"
    (cd "$place" && ./use) || fail "$place/use"
}
stops() { ! "$dir/checked/use" "$1" >"$dir/out" 2>&1 && grep -q "$2" "$dir/out"; }

# Fortran 2008 is what the module needs (strict); later ones must take it, too.
build_and_run checked -O0 -g $checks
for standard in f2018 gnu; do
    if [ -n "$checks" ]; then
        mkdir -p "$dir/$standard"
        check "module with -std=$standard" quietly $FC -std=$standard -Wall -Wextra -Werror -J"$dir/$standard" \
            -fsyntax-only "$build/harmorph.f90"
    fi
done
while read -r mode words; do check "stop: $words" stops $mode "$words"; done <<END
one_iteration harmorph: plan%solve: HM_NOT_CONVERGED: [a-z]
part_of_the_way harmorph: plan%morph_safe: HM_SHORT: the mesh could follow
save_nothing harmorph: basis%save: HM_BAD_ARGUMENT: the basis is empty: there is nothing to save
one_array_twice harmorph: mesh%points: HM_BAD_ARGUMENT: x and y are the same array
assign_mesh a mesh cannot be assigned
assign_plan a plan cannot be assigned
assign_basis a basis cannot be assigned
END
if [ -n "$long" ]; then build_and_run long $long; fi

# Another compiler, which passes arrays in other ways. FLANG=... says which.
for flang in $FLANG flang flang-new flang-new-22 flang-new-20 flang-new-19 flang-19; do
    command -v "$flang" >/dev/null && break
    flang=
done
if [ -n "$flang" ]; then
    (strict= loose= FC=$flang FFLAGS=-O1 passed=0 failed=0
        quietly() { "$@"; }   # warnings of one compiler are not those of another
        build_and_run flang
        finish) || fail flang
else
    skip flang "it is not installed (Debian: flang-19)"
fi

# An array that a mesh keeps must outlive the call; the compiler checks this.
refused_by_compiler() {   # declaration of x, actual argument
    cat >"$dir/kept.f90" <<END
use harmorph
$1 :: x(10)
double precision, target :: y(10)
type(hm_mesh) :: mesh
call mesh%points($2, y)
end
END
    $FC $FFLAGS -I"$dir/checked" -J"$dir" -fsyntax-only "$dir/kept.f90"
}
is_refused_by_compiler() { ! refused_by_compiler "$@"; }
check "an array with TARGET is taken" refused_by_compiler "double precision, target" x
check "an array without TARGET is refused" is_refused_by_compiler "double precision" x
check "an expression is refused" is_refused_by_compiler "double precision, target" "2 * x"
check "a copy in parentheses is refused" is_refused_by_compiler "double precision, target" "(x)"
# The shortest use at the head of the module compiles.
shortest_use() {
    { echo "subroutine page(n, cells, face_points, markers, wing, dx, dy, dj_dx, dj_dy)"
      echo "use, intrinsic :: iso_c_binding, only: c_double"
      echo "use harmorph"
      echo "implicit none"
      echo "integer, intent(in) :: n, cells(:, :), face_points(:, :), markers(:), wing"
      echo "real(c_double), intent(inout), target :: dx(:), dy(:), dj_dx(:), dj_dy(:)"
      sed -n '/^! THE SHORTEST USE/,/^! ORDER OF CALLS/s/^!     //p' "$build/harmorph.f90"
      echo "end subroutine"; } >"$dir/page.f90"
    grep -q 'call basis%adjoint' "$dir/page.f90" &&
        $FC -std=f2008 -I"$dir/checked" -J"$dir" -fsyntax-only "$dir/page.f90"
}
check "the shortest use at the head of the module" shortest_use
stat_and_err_last() { ! tr '\n' '~' <"$build/harmorph.f90" | sed 's/&~ *//g' | tr '~' '\n' |
    grep -E '^ *subroutine .*\bstat\b' | grep -v 'stat, err)$'; }
check "stat and err are the last arguments of every call" stat_and_err_last
# A struct whose size depends on the pointers of the machine, by its members: int32_t, size_t, double, int32_t.
size_by_members() {
    printf '%s\n' 'struct hm_x' 'member hm_x struct_size int32 1' 'member hm_x n size 1' 'member hm_x x double 1' \
        'member hm_x i int32 1' 'end hm_x' | awk -f fortran/type_of.awk -f fortran/declarations.awk |
        grep -F 'struct_size = merge(32, 24, storage_size(c_null_ptr) == 64)'
}
check "the size of a struct with size_t" size_by_members
headers=$(sed 's|^|include/|' fortran/harmorph/headers)
# Structs and constants of the headers in a folder against those of a module that was made from these headers.
compare_layouts() {   # folder that contains include/, folder of the module's objects
    place=$2
    (cd "$1" && awk -f "$OLDPWD/c_api/packaging/table.awk" $headers) >"$place/table"
    for side in c fortran; do
        awk -v layout=$side -f fortran/type_of.awk -f fortran/declarations.awk "$place/table" \
            >"$place/layout_${side%ortran}.inc"
    done
    check "layout.c" $CC -I"$place" -std=c99 -pedantic -Wall -Wextra -Werror -I"$1/include" $CFLAGS \
        -c tests/fortran/layout.c -o "$place/layout_c.o"
    check "layout.f90" quietly $FC $strict $FFLAGS $checks -I"$place" -J"$place" -c tests/fortran/layout.f90 \
        -o "$place/layout.o"
    check "link of layout" $FC $FFLAGS $checks "$place/layout.o" "$place/layout_c.o" "$place/harmorph.o" \
        "$build/libharmorph.a" -o "$place/layout"
    "$place/layout" || fail "$place/layout"
}
compare_layouts . "$dir/checked"
# Read in another way, the headers have the same constants and structs.
names_in_headers() {
    cat $headers | sed -n '/^enum/,/};/p' | grep -o 'HM_[A-Z0-9_]* =' | sed 's/\(.*\) =/constant \1/'
    sed -n 's/^typedef \(struct [a-z_]*\) {.*/\1/p' $headers
}
same_names() {
    names_in_headers | sort >"$dir/names"
    sed -n 's/^\(constant [^ ]*\).*/\1/p; /^struct/p' "$dir/checked/table" | grep -v HM_ABI | sort | diff "$dir/names" -
}
check "all constants and structs of the headers are compared" same_names
# A new constant, a new member in a reserved place and a new call are one edit: that of the header.
mkdir -p "$dir/edited"
cp -R include "$dir/edited"
awk '/HM_STRATEGY_IMPROVED = 4/ { sub(/= 4/, "= 4,\n    HM_STRATEGY_ADDED = 5") }
    /^typedef struct hm_improve_options/ { in_options = 1 }
    in_options && sub(/reserved;/, "added;") { in_options = 0 }
    /^HM_API hm_status hm_plan_solve/ {
        print "HM_API hm_status hm_added(const hm_plan* plan, const hm_mesh* mesh, double of, int32_t* numbers,"
        print "                          size_t* bytes, hm_error* err); /* The comment of the call. */"
    }
    { print }' include/harmorph.h >"$dir/edited/include/harmorph.h"
join_edited() { HEADERS=$dir/edited/include sh fortran/join.sh harmorph >"$dir/edited/harmorph.f90"; }
check "the module of the edited header" join_edited
check "the edited module" quietly $FC $strict $FFLAGS -O0 -J"$dir/edited" -c "$dir/edited/harmorph.f90" \
    -o "$dir/edited/harmorph.o"
compare_layouts "$dir/edited" "$dir/edited"
has_both() { grep hm_strategy_added "$dir/edited/$1" && grep '\badded\b' "$dir/edited/$1"; }
check "the new constant and member are in the module" has_both harmorph.f90
check "the new constant and member are compared" has_both layout_f.inc
new_call() {
    grep -A 7 -F 'hm_c_added(plan, mesh, of, numbers, bytes, err) bind(c,name="hm_added")' "$dir/edited/harmorph.f90" |
        sed 's/^ *//' >"$dir/edited/call"
    diff - "$dir/edited/call" <<'END' || return
integer(c_int32_t) function hm_c_added(plan, mesh, of, numbers, bytes, err) bind(c,name="hm_added")
import
type(c_ptr), value, intent(in) :: plan
type(hm_c_mesh), intent(in) :: mesh
real(c_double), value, intent(in) :: of
integer(c_int32_t), intent(inout) :: numbers(*)
integer(c_size_t), intent(inout) :: bytes
type(hm_c_error), intent(inout) :: err
END
    grep -B 1 'hm_c_added(plan' "$dir/edited/harmorph.f90" | grep 'The comment of the call'
}
check "the new call has an interface with the comment of the header" new_call
about_member() {
    grep -B 1 ':: min_area = 0' "$build/harmorph.f90" | grep '! \[length^2\] smallest signed corner area'
}
check "components have the comments of the header" about_member

# Every function of the headers must have an interface in the module, but for hm_init, which sets the fields of C
# structs to 0; the components of the derived types have initial values instead.
missing() {
    for name in $(sed -n 's/^HM_API .*[ *]\(hm_[a-z_]*\)(.*/\1/p' $headers | grep -vx hm_init); do
        grep -q "name=\"$name\"" "$build/harmorph.f90" || echo "$name"
    done
}
nothing_missing() { missing | tee "$dir/missing"; test ! -s "$dir/missing"; }
check "all of the header is in the module" nothing_missing
# What the list says of pointers is about arguments that the headers have; otherwise the list is older than the headers.
unknown_arguments() {
    awk -f c_api/packaging/table.awk $headers include/harmorph_mpi.h include/harmorph_petsc.h |
        awk '$1 == "argument" { known[$2, $3] = known["*", $3] = 1 }
            FILENAME ~ /arguments$/ && $1 != "#" {
                for (k = 3; k <= NF; ++k) if (!(($2, $k) in known)) print $2, $k
            }' - fortran/arguments
}
no_unknown_argument() { ! unknown_arguments | grep .; }
check "fortran/arguments names arguments of the headers" no_unknown_argument

# The legacy calls with the module of a place, and the same flags: DOUBLE PRECISION always has 8 bytes.
legacy_calls() {   # place, flags...
    place=$dir/$1; shift
    check "harmorph77.f90 with $*" quietly $FC $strict $FFLAGS "$@" -I"$place" -J"$place" -c "$build/harmorph77.f90" \
        -o "$place/harmorph77.o"
    check "legacy_tools.f with $*" $FC $legacy $FFLAGS "$@" -c tests/fortran/legacy_tools.f -o "$place/legacy_tools.o"
    sed -n '/^```fortran/,/^```$/p' fortran/harmorph77/README.md | grep -v '^```' >"$place/legacy_page.inc"
    for test in legacy legacy_cells legacy_design legacy_fields legacy_refused legacy_page; do
        check "$test.f with $*" $FC $legacy $FFLAGS "$@" -I"$place" -c tests/fortran/$test.f -o "$place/$test.o"
        check "link of $test with $*" $FC $FFLAGS "$@" "$place/$test.o" "$place/legacy_tools.o" "$place/harmorph77.o" \
            "$place/harmorph.o" "$build/libharmorph.a" -o "$place/$test"
        "$place/$test" || fail "$place/$test"
    done
}
legacy_calls checked -O0 $checks
if [ -n "$long" ]; then legacy_calls long $long -fdefault-double-8; fi
# Options that make default or single precision double: the example with reals of the default kind prints what the
# example prints.
example() {   # place, flags...: the example in this place, with the module compiled there
    place=$dir/$1; shift
    mkdir -p "$place"
    check "module with $*" quietly $FC $strict $FFLAGS -O0 "$@" -J"$place" -c "$build/harmorph.f90" \
        -o "$place/harmorph.o"
    check "the example with $*" quietly $FC $FFLAGS -O0 "$@" -I"$place" "$place/morph.f90" "$place/harmorph.o" \
        "$build/libharmorph.a" -o "$place/morph"
    "$place/morph" >"$place/out"
}
mkdir -p "$dir/plain" && cp fortran/examples/morph.f90 "$dir/plain" && example plain
if [ -n "$long" ]; then
    for flag in -freal-4-real-8 -fdefault-real-8; do
        mkdir -p "$dir/promoted$flag"
        sed 's/real(dp)/real/' fortran/examples/morph.f90 >"$dir/promoted$flag/morph.f90"
        example promoted$flag $flag
        check "the example prints the same with $flag" cmp "$dir/plain/out" "$dir/promoted$flag/out"
    done
fi
# Every legacy call is in the manual at the head of the file, and is called by a test.
unknown_calls() {
    for name in $(sed -n 's/^subroutine \(hm[a-z]*\)(.*/\1/p' "$build/harmorph77.f90" | tr a-z A-Z); do
        grep -q "^!.*\b$name\b" "$build/harmorph77.f90" && grep -q "CALL $name " tests/fortran/legacy*.f || echo "$name"
    done
}
# The calls of the manual, whose arguments are in columns 7 to 63, have as many as the subroutines. The example at the
# head is that of README.md.
legacy_heads() { awk '{ print $1, gsub(/,/, "") + 1 }' | tr a-z A-Z | sort -u; }
manual_agrees() {
    sed -n '1,/^! BEGIN/p' "$build/harmorph77.f90" | sed -n 's/^!  *\(IF (S [^)]*) \)*\(CALL .*\)/\2/p' >"$dir/example"
    grep -o 'CALL .*' fortran/harmorph77/README.md | diff - "$dir/example" || return 1
    sed '1,/^! BEGIN/d' "$build/harmorph77.f90" |
        awk '/^!     CALL HM/ { inside = 1; text = "" }
            inside { text = text substr($0, 7, 57) }
            inside && text ~ /[)]/ { sub(/[)].*/, "", text); sub(/^CALL */, "", text); print text; inside = 0 }' |
        legacy_heads >"$dir/in_manual"
    awk '/^subroutine hm/ { text = $0; while (text ~ /&$/) { getline; sub(/&$/, "", text); text = text $0 }
        sub(/subroutine /, "", text); sub(/[(]/, " (", text); print text }' "$build/harmorph77.f90" |
        legacy_heads >"$dir/in_source"
    test -s "$dir/in_source" && diff "$dir/in_source" "$dir/in_manual"
}
check "the manual of legacy calls has their arguments" manual_agrees
all_calls_known() { ! unknown_calls | grep .; }
check "legacy calls are in their manual and in the tests" all_calls_known
# The head of the module lists every call that examples and tests make, with the keywords that they use.
signatures() { sed -n '/^! ALL CALLS/,/^! THE MESH/p' "$build/harmorph.f90" | sed 's/^! *//'; }
unlisted_calls() {
    signatures | tr -d '\n' | sed 's/call /\ncall /g; s/n = /\nn = /g' >"$dir/signatures"
    cat fortran/examples/*.f90 tests/fortran/*.f90 tests/release/readme_*.f90 |
        grep -o 'call \(mesh\|curves\|plan\|basis\|quality\|plane\|walls\|interpolation\)%[a-z_]*(' | sort -u |
        while read -r call; do
            grep -qF -e "$call" "$dir/signatures" || echo "$call"
        done
}
all_calls_listed() { [ "$(signatures | grep -c '^call ')" -gt 90 ] && ! unlisted_calls | grep .; }
check "the head of the module lists all calls" all_calls_listed
arguments_are_listed() {   # with those that are optional in brackets, and ranks
    grep -qxF -e 'call curves%project(curve, x, y, u, distance)' "$dir/signatures" &&
        grep -qxF -e 'call mesh%points(x(..), y(..) [, first])' "$dir/signatures" &&
        grep -q '^call plan%analyse(mesh \[, curves, conditions(:), .*options' "$dir/signatures"
}
check "calls are listed with their arguments" arguments_are_listed

finish "$dir"
