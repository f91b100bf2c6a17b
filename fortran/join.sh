#!/bin/sh
# usage: join.sh FOLDER >FOLDER.f90
# One file for users to compile, of the parts in harmorph/, harmorph77/ or harmorph_mpi/: a module of those that the
# file `order` names, and behind it those that `after` names, unchanged. Each part of a module has declarations, a line
# `contains`, and procedures; the first ones are the manual and the begin of the module. What stands between !@each WHAT
# and !@end is there once for each line of `forms` that begins with WHAT: name, kind and shape.
cd "$(dirname "$0")/$1" || exit 1
forms=/dev/null
[ ! -f forms ] || forms=forms
part() {   # file, declarations or procedures
    awk -v wanted="$2" -v forms=$forms '
        FILENAME == forms { of[++n] = $1; form[n] = $2; kind[n] = $3; shape[n] = $4; next }
        FNR == 1 { half = "declarations" }
        /^contains$/ { half = "procedures"; next }
        half != wanted { next }
        /^!@each / { each = $2; text = ""; next }
        /^!@end$/ {
            for (k = 1; k <= n; ++k) {
                if (of[k] != each) continue
                copy = text
                gsub(/@FORM@/, form[k], copy)
                gsub(/@KIND@/, kind[k], copy)
                gsub(/@SHAPE@/, shape[k], copy)
                printf "%s", copy
            }
            each = ""
            next
        }
        each { text = text $0 "\n"; next }
        { print }' $forms "$1" || exit 1
}
for file in $(cat order); do part $file declarations; done
echo contains
for file in $(cat order); do part $file procedures; done
echo "end module"
[ ! -f after ] || cat $(cat after)
