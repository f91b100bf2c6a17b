#!/bin/sh
# usage: join.sh >harmorph.f90
# One file for users to compile: the modules of harmorph/ as its file `order` says. What stands between !@each WHAT and
# !@end is there once for each line of `forms` that begins with WHAT: name, kind and shape. join.cmake does the same.
cd "$(dirname "$0")/harmorph" || exit 1
while read -r file; do
    awk '
        FILENAME == "forms" { of[++n] = $1; form[n] = $2; kind[n] = $3; shape[n] = $4; next }
        /^!@each / { each = $2; text = ""; next }
        /^!@end$/ {
            for (k = 1; k <= n; ++k) {
                if (of[k] != each) continue
                its = text
                gsub(/@FORM@/, form[k], its)
                gsub(/@KIND@/, kind[k], its)
                gsub(/@SHAPE@/, shape[k], its)
                printf "%s", its
            }
            each = ""
            next
        }
        each { text = text $0 "\n"; next }
        { print }
        END { print "" }' forms "$file" || exit 1
done <order
