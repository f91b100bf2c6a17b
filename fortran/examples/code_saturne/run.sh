#!/bin/sh
# usage: run.sh BUILD   (called by `make test-saturne`)
# A pitching ellipse in code_saturne on one process and on two, with points moved by harmorph and by code_saturne's own
# diffusion. The test is skipped, with the reason, if code_saturne is missing. The wall turns by DEGREES in each time
# step; STEPS is the number of time steps.
here=$(cd "$(dirname "$0")" && pwd) build=$(cd "$1" && pwd)
dir=$build/saturne topic=code_saturne log=$build/saturne/log
. "$here/../../../tests/count.sh"
command -v code_saturne >/dev/null 2>&1 ||
    { echo "code_saturne is not tested, as it is not installed (Debian's code-saturne)"; exit 0; }
rm -rf "$dir"
mkdir -p "$dir/module" || exit 2
DEGREES=${DEGREES:-2} STEPS=${STEPS:-60} MESH_DIR=$dir HARMORPH_MODULE=$dir/module \
    HARMORPH_LIBRARY=$build/libharmorph.a
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
USER=${USER:-user}    # code_saturne needs this name
export USER DEGREES STEPS MESH_DIR HARMORPH_MODULE HARMORPH_LIBRARY OMPI_ALLOW_RUN_AS_ROOT \
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_rmaps_base_oversubscribe
awk -v ni="${NI:-64}" -v nj="${NJ:-32}" -f "$here/mesh.awk" >"$dir/mesh.msh"
# The program of the page, in an empty folder, with an installation in an empty home.
first_case() (
    mkdir -p "$dir/home/first" && ${MAKE:-make} -s -C "$here/../../.." BUILD="$build" PREFIX="$dir/home/opt" install &&
        cd "$dir/home/first" && awk '/^```/ { inside = 0 } inside { print } /^```sh/ { inside = 1 }' "$here/README.md" \
            >lines.sh && HOME=$dir/home sh -e lines.sh >out && cat out && grep -q 'mesh at  *38' out
)
check "the first case of the page" first_case
cd "$dir" || exit 2
code_saturne create -s study -c case >"$log" 2>&1
cp "$here"/cs_user_*.f90 study/case/SRC/
( cd module && ${FC:-gfortran} -I"${SATURNE_INCLUDE:-/usr/include/code_saturne}" -c "$build/harmorph.f90" \
    "$here/moving_mesh.f90" ) || exit 2
cp "$here/cs_user_scripts.py" study/case/DATA/

# run NAME FOLLOW PROCESSES
run() {
    FOLLOW=$2; export FOLLOW
    ( cd study/case/SCRIPTS && code_saturne run --id "$1" -n "$3" ) >"$dir/$1.out" 2>&1
    cp "$dir/study/case/RESU/$1/listing" "$dir/$1.listing" 2>/dev/null || cp "$dir/study/case/RESU/$1/run_solver.log" \
        "$dir/$1.listing" 2>/dev/null
    grep -a '^ *mesh at' "$dir/$1.listing" | awk '{ print $3, $NF }' >"$dir/$1.quality"
}
run harmorph 1 1
run harmorph_two 1 2
run own 0 1
passes "harmorph on one process: the run" "$(grep -q 'END OF CALCULATION' harmorph.listing; echo $?)" harmorph.out
check "harmorph on one process: all steps" test "$(wc -l <harmorph.quality)" -ge "$STEPS"
check "harmorph: the same qualities on two processes" \
    sh -c 'test -s harmorph_two.quality && cmp harmorph.quality harmorph_two.quality'
last() { awk '$2 > 0 { angle = $1; quality = $2 } $2 <= 0 { exit } END { print angle, quality }' "$1.quality"; }
for name in harmorph own; do
    echo "$name: valid up to $(last $name) (degrees, smallest quality)" "$(awk '/User CPU time/ { t = $4 } END { if (t)
        print "; processor time of the run:", t, "s" }' "study/case/RESU/$name/performance.log")"
done
grep -a '^ *harmorph: .* ms' harmorph.listing | tail -n 1
check "harmorph goes farther than the diffusion of code_saturne, or as far with better cells" \
    awk "BEGIN { split(\"$(last harmorph)\", a); split(\"$(last own)\", b)
        exit !(a[1] + 0 > b[1] + 0 || (a[1] == b[1] && a[2] + 0 > b[2] + 0)) }"
finish
