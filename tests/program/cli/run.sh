#!/bin/sh
# usage: sh tests/program/cli/run.sh path/to/harmorph path/to/meshes folder/for/output [PART...]
# Tests of the program, one part after the other: each is one topic, in the file of its name, and needs nothing of the
# others but what common.sh, ring.sh and box.sh define.
if [ $# -lt 3 ]; then
    echo "usage: sh tests/program/cli/run.sh HARMORPH MESHES OUTPUT [PART...]" >&2
    exit 2
fi
harmorph=$1 meshes=$2 tmp=$3/cli-test here=$(dirname "$0")
shift 3
rm -rf "$tmp" # some checks look for files that must not be there
mkdir -p "$tmp" || exit 2
topic=program log=$tmp/log
. "$here/../../count.sh"
. "$here/common.sh"
. "$here/ring.sh"
. "$here/box.sh"
parts="exit_codes path again mesh_files bad_files displace transfer operators slip periodic rigid safe
    markers names grammar shared curves sections demo design sample outputs adjoint movements fields tables endings
    options"
if [ $# -gt 0 ]; then parts=$*; fi
for part in $parts; do
    . "$here/$part.sh"
    leaves_nothing "$part: refused commands leave no file" "$tmp/x"
done
finish
