#!/bin/sh
# usage: join.sh >harmorph.f90
# One file with one module for users to compile, of the parts in harmorph/ that the file `order` names. Each part has
# declarations, a line `contains`, and procedures; manual.f90 begins the module. What stands between !@each WHAT and !@end
# is there once for each line of `forms` that begins with WHAT: name, kind and shape.
cd "$(dirname "$0")/harmorph" || exit 1
parts=$(cat order)
part() {   # file, declarations or procedures
    awk -v wanted="$2" '
        FILENAME == "forms" { of[++n] = $1; form[n] = $2; kind[n] = $3; shape[n] = $4; next }
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
        { print }' forms "$1" || exit 1
}
for file in $parts; do part $file declarations; done
echo contains
for file in $parts; do part $file procedures; done
echo "end module"
