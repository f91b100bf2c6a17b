#!/bin/sh
# usage: copy_objects.sh ORIGINAL COMPILER ARGUMENTS...
# Stands in for a compiler where the rules that call it are tested: copies the object from ORIGINAL, the folder of a
# build, and calls the compiler to link.
original=$1 compiler=$2 compiles= object=
shift 2
for word do
    case $word in -c) compiles=1 ;; *objects/*.o) object=$word ;; esac
done
if [ -z "$compiles" ]; then exec $compiler "$@"; fi
cp "$original/objects/${object##*objects/}" "$object"
