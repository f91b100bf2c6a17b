# No output replaces an input or another output, however the paths are spelled. The folder `outputs` holds one small
# file for each kind of input; a refused command leaves all bytes of the folder as they were.

outputs=$tmp/outputs
mkdir "$outputs" && outputs=$(cd "$outputs" && pwd)
cp "$ring" "$outputs/mesh.su2"
cp "$curve" "$outputs/a.curve"
cp "$basis" "$outputs/a.basis"
cp "$basis" "$outputs/b.basis"
cp "$tmp/small.txt" "$outputs/moves"
awk 'BEGIN { for (i = 0; i < 48; ++i) print i, 0, .01 }' >"$outputs/field"
echo '1 .01' >"$outputs/values"
case $harmorph in /*) program=$harmorph ;; *) program=$PWD/$harmorph ;; esac
in_outputs() { (cd "$outputs" && "$program" "$@") >"$tmp/out" 2>"$tmp/err"; }
in_outputs variables a.curve --naca .4 --chord=-1,0,1,0 -o map || fail "an input cannot be made: map" "$tmp/err"
in_outputs fit mesh.su2 --marker body -o section.dat || fail "an input cannot be made: section.dat" "$tmp/err"
bytes_of_outputs() { (cd "$outputs" && ls && cat -- * 2>/dev/null | cksum); } # folders and links to nothing aside
before=$(bytes_of_outputs)

stays_as() { # stays_as NAME WORDS...: refused as wrong usage, because two files are one, and no byte has changed
    name=$1; shift
    in_outputs "$@"
    status=$?
    if [ $status = 2 ] && grep -q 'are the same file' "$tmp/err" && [ "$(bytes_of_outputs)" = "$before" ]; then
        ok
    else
        fail "$name: exit code $status, or other bytes: $*" "$tmp/err"
    fi
}
# Each line: the inputs of the command, and its words, of which OUT is an output.
while read -r line; do
    inputs=${line%% : *} words=${line#* : }
    for input in $inputs; do
        (cd "$outputs" && ln -s "$input" by_symbolic_link && ln "$input" by_hard_link && ln -s . here &&
            ln -s by_symbolic_link by_two_links)
        before=$(bytes_of_outputs)
        for spelling in "$input" "./$input" "../outputs/$input" "$outputs/$input" "here/$input" by_symbolic_link \
            by_hard_link by_two_links; do
            stays_as "an output over $input" $(echo "$words" | sed "s|OUT|$spelling|")
        done
        (cd "$outputs" && rm by_symbolic_link by_hard_link by_two_links here)
        before=$(bytes_of_outputs)
    done
done <<END
mesh.su2 : fit mesh.su2 --marker body -o OUT
mesh.su2 field : fit mesh.su2 --marker body --weights field -o OUT
a.curve : fit a.curve -o OUT
section.dat : fit section.dat -o OUT
mesh.su2 a.curve : solve mesh.su2 --curve body=a.curve -o OUT
mesh.su2 a.curve field : solve mesh.su2 --curve body=a.curve --given far --mode field -o OUT
mesh.su2 a.curve : solve mesh.su2 --curve body=a.curve --operator laplace --engine multigrid --history OUT -o new
mesh.su2 a.curve : solve mesh.su2 --rigid body --slip far=a.curve -o OUT
a.basis moves : morph mesh.su2 a.basis --move moves -o OUT
mesh.su2 a.basis moves : morph mesh.su2 a.basis --move moves -o new --curve-out OUT
mesh.su2 a.basis moves : morph mesh.su2 a.basis --move moves --safe --reached OUT
mesh.su2 a.basis moves b.basis : morph mesh.su2 a.basis --move moves --safe --other b.basis --vtu OUT
mesh.su2 a.basis moves : morph mesh.su2 a.basis --move moves --svg OUT
mesh.su2 a.basis moves : morph mesh.su2 a.basis --move moves --boundary-svg OUT
mesh.su2 a.basis moves : morph mesh.su2 a.basis --move moves --csv OUT
mesh.su2 a.basis moves : morph mesh.su2 a.basis --move moves --report=OUT
mesh.su2 a.basis values map : morph mesh.su2 a.basis --variables map --move values --csv OUT
mesh.su2 a.basis section.dat : morph mesh.su2 a.basis --to-airfoil section.dat --moves-out OUT
field : displace mesh.su2 --given body --wall field -o OUT
mesh.su2 field : displace mesh.su2 --given body --wall field --vtu OUT
mesh.su2 field : displace mesh.su2 --given body --wall field --report OUT
a.curve moves : displace mesh.su2 --given far --wall field --curve body=a.curve --move moves -o OUT
mesh.su2 a.basis : export mesh.su2 a.basis --function 1 --csv OUT
mesh.su2 a.basis : export mesh.su2 a.basis --function 1 --vtu OUT
mesh.su2 a.basis b.basis : export mesh.su2 a.basis --beside b.basis --function 1 --svg OUT
mesh.su2 a.basis : export mesh.su2 a.basis --function 1 --contour-csv OUT
mesh.su2 a.curve : check mesh.su2 --curve a.curve --svg OUT
mesh.su2 a.basis : transfer mesh.su2 a.basis mesh.su2 -o OUT
mesh.su2 a.basis moves : explore mesh.su2 a.basis --move moves -o OUT
mesh.su2 : convert mesh.su2 OUT
mesh.su2 a.basis field map : adjoint mesh.su2 a.basis --sensitivity field --variables map -o OUT
mesh.su2 a.basis field map values : adjoint mesh.su2 a.basis --sensitivity field --variables map --at values -o OUT
a.curve : curve a.curve --halve -o OUT
a.curve : variables a.curve --naca .4 -o OUT
a.curve section.dat : variables a.curve --family section.dat -o OUT
END

# Two outputs of one command, which need not exist.
ln -s not_there "$outputs/to_nothing"
before=$(bytes_of_outputs)
for other in new ./new ../outputs/new "$outputs/new"; do
    for pair in "-o new --svg" "-o new --vtu" "--csv new --report" "--svg new --boundary-svg" \
        "-o x --curve-out new --svg"; do
        stays_as "two outputs" morph mesh.su2 a.basis --move moves $pair "$other"
    done
    stays_as "two outputs of export" export mesh.su2 a.basis --function 1 --csv new --svg "$other"
    stays_as "two outputs of solve" solve mesh.su2 --curve body=a.curve --operator laplace --engine fas --history new \
        -o "$other"
done
stays_as "two outputs by a link to no file" morph mesh.su2 a.basis --move moves -o not_there --svg to_nothing
stays_as "an output over the curve beside -o" morph mesh.su2 a.basis --move moves -o new --svg new.curve
stays_as "an output over the movement beside -o" morph mesh.su2 a.basis --move moves --safe --force -o new \
    --svg new.reached
stays_as "a picture over the mesh that replaces itself" morph mesh.su2 a.basis --move moves -o mesh.su2 --svg mesh.su2
rm "$outputs/to_nothing"

# Three things are allowed: a morphed mesh in place of the mesh, two outputs to one device, and curves beside -o as
# before.
(cd "$outputs" && cp mesh.su2 kept.su2 && ln -s mesh.su2 link.su2)
for place in mesh.su2 ./mesh.su2 link.su2; do
    cp "$outputs/kept.su2" "$outputs/mesh.su2"
    check "a morphed mesh in place of the mesh: $place" in_outputs morph mesh.su2 a.basis --move moves -o "$place"
    check "a morphed mesh in place of the mesh: it has moved" sh -c '! cmp -s "$1/mesh.su2" "$1/kept.su2"' sh "$outputs"
done
check "a link to the mesh stays a link" test -L "$outputs/link.su2"
cp "$outputs/kept.su2" "$outputs/mesh.su2"
check "a displaced mesh in place of the mesh" in_outputs displace mesh.su2 --given body --wall field -o mesh.su2
cp "$outputs/kept.su2" "$outputs/mesh.su2"
check "two outputs to one device" in_outputs morph mesh.su2 a.basis --move moves --svg /dev/null --csv /dev/null
check "a movement that names the curve beside -o, not written without --force" \
    in_outputs morph mesh.su2 a.basis --move moves --safe -o new --csv new.reached

# Files beside a mesh that belong to it.
mkdir -p "$outputs/case/constant/polyMesh"
(cd "$outputs/case/constant/polyMesh" && touch points faces owner neighbour boundary)
for name in faces owner neighbour boundary; do
    refuses "an output over $name of OpenFOAM" 2 'are the same file' fit "$outputs/case" --marker a \
        -o "$outputs/case/constant/polyMesh/$name"
done
cp "$ring" "$outputs/grid.x"
for ending in nmf mapbc; do
    echo 0 >"$outputs/grid.$ending"
    refuses "an output over .$ending" 2 'are the same file' check "$outputs/grid.x" --svg "$outputs/grid.$ending"
done

# The demo reads its mesh, and writes many files.
mkdir "$outputs/demo"
cp "$meshes/naca0012.su2" "$outputs/demo/fine.su2"
refuses "the demo over its mesh" 2 'are the same file' demo "$outputs/demo" --mesh "$outputs/demo/fine.su2"
check "the demo over its mesh: unchanged" cmp "$meshes/naca0012.su2" "$outputs/demo/fine.su2"
check "the demo over its mesh: nothing else" test "$(ls "$outputs/demo")" = fine.su2
rm -rf "$outputs"
