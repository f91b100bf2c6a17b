#!/bin/sh
# usage: join.sh >harmorph_petsc.c   (in the top directory)
# harmorph_petsc.c with its parts in one file, which needs only installed headers: what users compile.
awk '
function put(path,    line, name) {
    while ((getline line <path) > 0) {
        if (line ~ /^#include "petsc\//) {
            name = line
            gsub(/^[^"]*"|"[^"]*$/, "", name)
            print ""
            put("c_api/" name)
        } else if (line !~ /^#include "/) print line
        else if (!included++) print "#include <harmorph_petsc.h>"
    }
    close(path)
}
BEGIN { put("c_api/harmorph_petsc.c") }'
