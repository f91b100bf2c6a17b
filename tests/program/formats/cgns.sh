# CGNS: files that are written and read by a program made with libcgns. (A part of tests/program/formats.sh.)
if echo '#include <cgnslib.h>' | $CXX -x c++ -E - >/dev/null 2>&1 && command -v cgnsdiff >/dev/null 2>&1; then
    # What `make CGNS=1` makes: the same objects but for some, which are compiled with libcgns.
    with_cgns=$tmp/harmorph-cgns build=`dirname "$harmorph"`
    objects="`sed 's/[^ ]*formats-cgns[^ ]*//g' "$build/objects/program.list"` $build/objects/cli/c_api-cli-main.o"
    check "a program with CGNS is made" $CXX -std=c++17 -O0 -pthread -DHARMORPH_CGNS -Iinclude -Ic_api/cli \
        -o "$with_cgns" c_api/cli/formats/cgns*.cpp $objects "$build/libharmorph.a" -lcgns
    check "make_cgns is compiled" ${CC:-cc} -O0 -o "$tmp/make_cgns" tests/program/formats/make_cgns.c -lcgns -lm
    for kind in plane planes block cells polygons solid; do
        for real in double single; do
            what="cgns $kind $real" mesh=$tmp/$kind.cgns moved=$tmp/moved.cgns
            rm -f "$mesh" "$moved"
            check "$what: is written by libcgns" "$tmp/make_cgns" "$mesh" $kind $real
            check "$what: check" "$with_cgns" check "$mesh" --json
            says "$what: markers" '"markers": [{"name": "body", "faces": 24}, {"name": "far", "faces": 24}]'
            check "$what: fit" "$with_cgns" fit "$mesh" --marker body --points 8 -o "$tmp/curve"
            check "$what: solve" "$with_cgns" solve "$mesh" --curve "body=$tmp/curve" -o "$tmp/basis"
            check "$what: zero move" "$with_cgns" morph "$mesh" "$tmp/basis" --move "$tmp/none.txt" -o "$moved"
            check "$what: zero move: nothing differs" \
                sh -c "cgnsdiff -d '$mesh' '$moved' >'$tmp/a' && ! test -s '$tmp/a'"
            check "$what: morph" "$with_cgns" morph "$mesh" "$tmp/basis" --move "$tmp/moves.txt" -o "$moved"
            check "$what: check the morphed" "$with_cgns" check "$moved"
            check "$what: cgnscheck reads the morphed" cgnscheck "$moved"
            check "$what: cgnscheck finds no error" sh -c "! grep -qi error '$tmp/out'"
            check "$what: only coordinates differ" \
                sh -c "cgnsdiff -d '$mesh' '$moved' | grep -v -e 'Coordinate[XY]' | grep -q . && exit 1 || exit 0"
            test $kind = polygons && continue
            # The mesh in text moves as the mesh in the CGNS file does.
            "$with_cgns" convert "$mesh" "$tmp/a.su2" >"$tmp/out" 2>&1
            "$with_cgns" convert "$moved" "$tmp/b.su2" >"$tmp/out" 2>&1
            "$harmorph" solve "$tmp/a.su2" --curve "body=$tmp/curve" -o "$tmp/basis" >"$tmp/out" 2>&1
            check "$what: as text: morph" "$harmorph" morph "$tmp/a.su2" "$tmp/basis" --move "$tmp/moves.txt" \
                -o "$tmp/c.su2"
            tolerance=1e-12
            test $real = single && tolerance=1e-6
            check "$what: moves as all do" alike $tolerance "$tmp/b.su2" "$tmp/c.su2"
        done
    done
    for kind in bare whole old; do rm -f "$tmp/$kind.cgns"; "$tmp/make_cgns" "$tmp/$kind.cgns" $kind double; done
    "$with_cgns" check "$tmp/bare.cgns" --json >"$tmp/out" 2>&1
    says "cgns: no boundary conditions: loops have names" \
        '"markers": [{"name": "boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}]'
    "$with_cgns" check "$tmp/whole.cgns" --json >"$tmp/out" 2>&1
    says "cgns: a condition on all points: is reported" "the boundary condition 'whole' has all points of the mesh"
    says "cgns: a condition on all points: the others" '[{"name": "body", "faces": 24}, {"name": "far", "faces": 24}]'
    "$with_cgns" fit "$tmp/old.cgns" --marker body --points 8 -o "$tmp/curve" >"$tmp/out" 2>&1
    "$with_cgns" solve "$tmp/old.cgns" --curve "body=$tmp/curve" -o "$tmp/basis" >"$tmp/out" 2>&1
    check "cgns: an older version: morph" "$with_cgns" morph "$tmp/old.cgns" "$tmp/basis" --move "$tmp/moves.txt" \
        -o "$tmp/moved-old.cgns"
    check "cgns: an older version: which" sh -c "'$tmp/make_cgns' version '$tmp/old.cgns' | grep -F 3.10"
    check "cgns: an older version: stays" sh -c "'$tmp/make_cgns' version '$tmp/moved-old.cgns' | grep -F 3.10"
    "$tmp/make_cgns" "$tmp/cube.cgns" cube double
    refuses "cgns: three dimensions in earnest" 'the mesh has three dimensions and is not one cell thick' "$with_cgns" \
        check "$tmp/cube.cgns"
    refuses "cgns: three dimensions in earnest: where" "zone 'Zone1', point (1, 1, 1), CoordinateX" "$with_cgns" \
        check "$tmp/cube.cgns"
    for kind in nan skew outside; do "$tmp/make_cgns" "$tmp/$kind.cgns" $kind double; done
    refuses "cgns: a coordinate that is not finite" \
        "nan.cgns: zone 'Zone1', point (6, 2, 1), CoordinateY is not finite" "$with_cgns" check "$tmp/nan.cgns"
    refuses "cgns: a point that is opposite none" \
        "skew.cgns: zone 'Zone1', point (4, 3, 2), CoordinateX: the mesh has three" "$with_cgns" check "$tmp/skew.cgns"
    refuses "cgns: a cell of a point that does not exist" \
        "outside.cgns: zone 'Ring', section 'Cells': element 168 has point 1000, but there are 168 points" \
        "$with_cgns" check "$tmp/outside.cgns"
    # Sizes and ranges that the file does not have: within 256 MiB, the program refuses the file.
    for kind in plane cells block; do rm -f "$tmp/$kind.cgns"; "$tmp/make_cgns" "$tmp/$kind.cgns" $kind double; done
    cgns_claim() { # cgns_claim KIND TEXT NODE NUMBER...
        cp "$tmp/$1.cgns" "$tmp/bad.cgns"
        text=$2; shift 2
        check "cgns: $*: is written" "$tmp/make_cgns" claim "$tmp/bad.cgns" "$@"
        (ulimit -v 262144 && ulimit -t 60 && exec "$with_cgns" check "$tmp/bad.cgns") >"$tmp/out" 2>&1
        if [ $? -eq 3 ] && grep -F -e "$text" "$tmp/out" >/dev/null; then ok "cgns: $*"; else
            fail "cgns: $*: does not say '$text': $(head -n 1 "$tmp/out")"; fi
    }
    cgns_claim plane "Invalid coordinates array dimension" Base/Zone1 26 7 25 6 0 0
    # libcgns compares sizes of zones with those of coordinates, if there are any.
    for kind in plane block; do
        zone=Zone1
        check "cgns: $kind without coordinates" "$tmp/make_cgns" remove "$tmp/$kind.cgns" Base/$zone GridCoordinates
    done
    cgns_claim plane "zone 'Zone1' has 1073741824 points, which is more than a file of this size can hold" \
        Base/Zone1 32768 32768 32767 32767 0 0
    cgns_claim plane "zone 'Zone1' has more than 2147483647 points" \
        Base/Zone1 2147483647 2147483647 2147483646 2147483646 0 0
    cgns_claim block "zone 'Zone1' has more than 2147483647 points" \
        Base/Zone1 2097152 2097152 2097152 2097151 2097151 2097151 0 0 0
    cgns_claim plane "zone 'Zone1' has no CoordinateX and CoordinateY" Base/Zone1 25 7 24 6 0 0
    for kind in plane block; do rm -f "$tmp/$kind.cgns"; "$tmp/make_cgns" "$tmp/$kind.cgns" $kind double; done
    cgns_claim cells "section 'Cells' announces 2147483647 elements" Base/Ring/Cells/ElementRange 1 2147483647
    for kind in cells polygons; do
        rm -f "$tmp/$kind.cgns"
        "$tmp/make_cgns" "$tmp/$kind.cgns" $kind double
        cgns_claim $kind "section 'Cells': the ElementStartOffset of element 1 is out of range" \
            Base/Ring/Cells/ElementStartOffset -1 5
        cgns_claim $kind "section 'Cells': the ElementStartOffset of element 2 is out of range" \
            Base/Ring/Cells/ElementStartOffset 0 4 2147483647
    done
    cgns_claim cells "zone 'Ring', section 'Wall'" Base/Ring/Wall/ElementRange 169 2147483647
    cgns_claim cells "zone 'Ring', section 'Wall'" Base/Ring/Wall/ElementRange 192 169
    cgns_claim cells "names element 217, which is no face" Base/Ring/ZoneBC/body/PointRange 169 2147483647
    cgns_claim plane "has a point with the index 8 of 7" Base/Zone1/ZoneBC/far/PointRange 1 7 25 2147483647
    # Derivatives at the vertices: the gradient is that of a table with the same numbers. Both layers of a mesh that is
    # one cell thick are added.
    mesh=$tmp/mesh.cgns fields=$tmp/fields.cgns
    gradient() { # gradient NAME FILE OUTPUT OPTION...
        name=$1 from=$2 to=$3; shift 3
        check "$name" "$with_cgns" adjoint "$mesh" "$tmp/basis" --sensitivity "$from" -o "$to" "$@"
    }
    same_gradient() { # same_gradient NAME A B: in all lines but comments, which name the files
        grep -v '^#' "$2" >"$tmp/a" && grep -v '^#' "$3" >"$tmp/b" && cmp "$tmp/a" "$tmp/b" && ok "$1" || fail "$1"
    }
    for kind in plane planes cells polygons block solid; do
        for real in double single; do
            title="cgns fields: $kind $real" layers=1
            case $kind in block | solid) layers=2 ;; esac
            rm -f "$mesh"
            "$tmp/make_cgns" "$mesh" $kind double
            cp "$mesh" "$fields"
            "$with_cgns" solve "$mesh" --curve "body=$tmp/curve" -o "$tmp/basis" >"$tmp/out" 2>&1
            "$tmp/make_cgns" fields "$fields" $real >"$tmp/table"
            awk -v layers=$layers '{ x[NR - 1] = $2; y[NR - 1] = $3 }
                END { n = NR / layers
                      for (k = 0; k < NR; k++) { sx[k % n] += x[k]; sy[k % n] += y[k] }
                      for (k = 0; k < n; k++) printf "%d %.17g %.17g\n", k, sx[k], sy[k] }' \
                "$tmp/table" >"$tmp/table-of-plane"
            gradient "$title: from a table" "$tmp/table-of-plane" "$tmp/expected"
            gradient "$title: from the file" "$fields" "$tmp/gradient"
            same_gradient "$title: the same text" "$tmp/expected" "$tmp/gradient"
        done
    done
    gradient "cgns fields: by the names of arrays" "$fields" "$tmp/gradient" --x SensitivityX --y SensitivityY
    same_gradient "cgns fields: by the names of arrays: the same text" "$tmp/expected" "$tmp/gradient"
    refuses "cgns fields: an array that is not there" \
        "no column 'Lift_x'; the columns are 'x', 'y', 'z', 'SensitivityX'" "$with_cgns" \
        adjoint "$mesh" "$tmp/basis" --sensitivity "$fields" --vector Lift -o "$tmp/x"
    refuses "cgns fields: a program without CGNS" 'CGNS files are read by programs made with `make CGNS=1`' \
        "$harmorph" adjoint "$tmp/ring.su2" "$tmp/basis" --sensitivity "$fields" -o "$tmp/x"
    refuses_fields() { # refuses_fields WHAT KIND TEXT
        rm -f "$mesh"
        "$tmp/make_cgns" "$mesh" $2 double
        cp "$mesh" "$fields"
        "$with_cgns" solve "$mesh" --curve "body=$tmp/curve" -o "$tmp/basis" >"$tmp/out" 2>&1
        "$tmp/make_cgns" fields "$fields" $1 >"$tmp/table"
        refuses "cgns fields: $1" "$3" "$with_cgns" adjoint "$mesh" "$tmp/basis" --sensitivity "$fields" -o "$tmp/x"
    }
    # Points at the same place, as where zones meet: a derivative at one of them counts as at any other.
    rm -f "$mesh" && "$tmp/make_cgns" "$mesh" planes double
    "$with_cgns" solve "$mesh" --curve "body=$tmp/curve" -o "$tmp/basis" >"$tmp/out" 2>&1
    for point in 25 104; do # behind zone 1's last point of the second ring: the first one of that ring in zone 2
        echo "$point 1 2" >"$tmp/table"
        gradient "cgns fields: point $point alone" "$tmp/table" "$tmp/gradient-$point"
    done
    same_gradient "cgns fields: copies of a point count alike" "$tmp/gradient-25" "$tmp/gradient-104"
    # Other commands read the same fields.
    rm -f "$mesh" && "$tmp/make_cgns" "$mesh" cells double && cp "$mesh" "$fields"
    "$tmp/make_cgns" fields "$fields" double >"$tmp/table"
    check "cgns fields: interpolate" "$with_cgns" interpolate "$mesh" "$fields" "$mesh" -o "$tmp/there.csv"
    check "cgns fields: interpolate: the values of the file" awk -F '[ ,]' '
        NR == FNR { x[$1] = $2; y[$1] = $3; n++; next }
        FNR == 1 { bad = $4 != "SensitivityX" || $5 != "SensitivityY"; next }
        { m++; if (($4 - x[$1]) ^ 2 + ($5 - y[$1]) ^ 2 > 1e-24) bad = 1 } END { exit bad || m != n || n != 168 }' \
        "$tmp/table" "$tmp/there.csv"
    refuses_fields nan plane \
        "zone 'Zone1', point (6, 2, 1): the file needs a finite number for 'SensitivityY'"
    refuses_fields cells cells \
        "zone 'Ring' has no values at its vertices: the solution 'Adjoint' is at CellCenter"
    refuses_fields pressure cells \
        "the columns are 'x', 'y', 'z', 'Pressure'; the solution 'Adjoint' is at CellCenter, not at all vertices"
    refuses_fields short cells "dimension"
    refuses_fields other planes "zone 'Zone1' has no array 'OtherX' at its vertices, but zone 'Zone2' has"
    refuses_fields twice plane "the solutions 'Adjoint' and 'Again' both have the array 'SensitivityX'"
    refuses "cgns fields: no solution" "zone 'Zone1' has no values at its vertices: it has no FlowSolution_t" \
        "$with_cgns" adjoint "$mesh" "$tmp/basis" --sensitivity "$mesh" -o "$tmp/x"
    "$tmp/make_cgns" "$tmp/larger.cgns" block double
    "$tmp/make_cgns" fields "$tmp/larger.cgns" double >"$tmp/table"
    refuses "cgns fields: other points than the mesh" "zone 'Zone1', point (1, 1, 2): " \
        "$with_cgns" adjoint "$mesh" "$tmp/basis" --sensitivity "$tmp/larger.cgns" -o "$tmp/x"
    head -c 3000 "$tmp/plane.cgns" >"$tmp/bad.cgns"
    check "cgns: cut off" sh -c "'$with_cgns' check '$tmp/bad.cgns' >'$tmp/err' 2>&1; test \$? -eq 3"
    refuses "cgns: a program without it says so" 'CGNS files are read by programs made with' "$harmorph" \
        check "$tmp/plane.cgns"
else
    echo "libcgns is not installed: CGNS files are not tested (Debian's libcgns-dev and cgns-convert)"
fi
