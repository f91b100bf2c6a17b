#!/bin/sh
# `make bench PARTS=files`: a mesh of a million points from each format to SU2, by harmorph and, where it is installed,
# by gmsh. Seconds of processor time (user and system), so that other work on the machine counts little;
# MB/s of the file read. With two threads: seconds of wall time, which mean something on an idle machine only.
: "${BUILD:=build}" "${PYTHON:=/usr/bin/python3}" "${ROUND:=1000}" "${OUTWARDS:=1000}"
out=$BUILD/bench harmorph=$BUILD/harmorph
mkdir -p "$out" || exit 1
awk -v n="$ROUND" -v m="$OUTWARDS" -f tests/program/formats/large_mesh.awk >"$out/files.su2"
"$harmorph" convert "$out/files.su2" "$out/files-2.msh" >/dev/null || exit 1
# The same O-mesh as PLOT3D in text and as unformatted records of Fortran.
$PYTHON - "$ROUND" "$OUTWARDS" "$out/files-text.p3d" "$out/files-binary.p3d" <<'END' || exit 1
import sys, numpy, scipy.io
around, outwards = map(int, sys.argv[1:3])
r = numpy.exp(numpy.log(20) * numpy.arange(outwards + 1) / outwards)[:, None]
z = r * numpy.exp(2j * numpy.pi * (numpy.arange(around + 1) % around) / around)
at = numpy.concatenate([z.real.ravel(), z.imag.ravel(), numpy.zeros(z.size)])
numpy.savetxt(sys.argv[3], at, "%.16e", header=f"1\n{around + 1} {outwards + 1} 1", comments="")
with scipy.io.FortranFile(sys.argv[4], "w") as file:
    for record in (numpy.int32([1]), numpy.int32([around + 1, outwards + 1]), at[:2 * z.size]):
        file.write_record(record)
END
meshes="files.su2 files-2.msh files-text.p3d files-binary.p3d"
if command -v gmsh >/dev/null 2>&1; then
    gmsh -0 -v 1 "$out/files-2.msh" -save -format msh41 -bin -o "$out/files-4.msh" && meshes="$meshes files-4.msh"
    # It reads PLOT3D as text only.
else
    echo "gmsh is not installed: harmorph alone"
fi
# seconds PATTERN COMMAND...: the least of three runs that write a new file; the pattern is (user|sys) or real
seconds() {
    pattern=$1; shift
    for run in 1 2 3; do
        rm -f "$out/converted.su2" "$out/peer.su2"
        { time -p "$@" >/dev/null; } 2>&1 | awk "/^$pattern/"' { s += $2 } END { print s }'
    done | sort -n | head -n 1
}
printf '%-17s %10s %12s %10s %12s %10s\n' "to SU2 from" MB "harmorph s" MB/s "2 threads s" "gmsh s"
for mesh in $meshes; do
    size=$(wc -c <"$out/$mesh")
    two=$(seconds real "$harmorph" convert "$out/$mesh" "$out/converted.su2" --threads 2)
    ours=$(seconds "(user|sys)" "$harmorph" convert "$out/$mesh" "$out/converted.su2")
    peer=-
    if command -v gmsh >/dev/null 2>&1 && [ $mesh != files-binary.p3d ]; then
        peer=$(seconds "(user|sys)" gmsh -0 -v 1 "$out/$mesh" -save -o "$out/peer.su2")
    fi
    echo "$mesh $size $ours $two $peer" | awk '{
        megabytes = $2 / 1e6
        printf "%-17s %10.1f %12.2f %10.0f %12.2f %10s\n", $1, megabytes, $3, megabytes / $3, $4, $5
    }'
done
rm -f "$out"/files.su2 "$out"/files-?.msh "$out"/files-*.p3d "$out/converted.su2" "$out/peer.su2"
