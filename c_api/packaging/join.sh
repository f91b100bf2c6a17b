#!/bin/sh
# usage: join.sh FOLDER >harmorph_FOLDER.c   (in the top directory; FOLDER: mpi, petsc)
# Users compile one file, which needs only installed headers: c_api/FOLDER/harmorph_FOLDER.c with its parts, and with
# c_api/private.h, the calls for modules alone.
awk -v folder="$1" '
function put(path,    line, name) {
    while ((getline line <path) > 0) {
        if (line ~ "^#include \"((mpi|petsc)/|private)") {
            name = line
            gsub(/^[^"]*"|"[^"]*$/, "", name)
            if (name in once) continue
            once[name] = 1
            print ""
            put("c_api/" name)
        } else if (line !~ /^#include "/) print line
        else if (!included++) print "#include <harmorph_" folder ".h>"
    }
    close(path)
}
BEGIN { put("c_api/" folder "/harmorph_" folder ".c") }'
