#!/bin/sh
# usage: describe.sh LIBRARY DIR [private]   (CC from the environment; in the top directory)
# The binary interface of the C headers and the library, as text: exported calls with their declarations, structs with
# the places and sizes of all members, and constants. All names are read from the headers (c_api/packaging/table.awk),
# so that none can be forgotten here. private: the same of c_api/private.h, the calls for modules alone.
: "${CC:=cc}"
library=$1 dir=$2
headers=$(grep -l '^HM_API' include/*.h) among='!/ _?hm_private_/'
if [ "${3-}" = private ]; then headers=c_api/private.h among='/ _?hm_private_/'; fi
without_comments() { cat $headers | tr '\n' '~' | sed 's|/\*[^*]*\**\([^/*][^*]*\**\)*\*/||g' | tr '~' '\n'; }
mkdir -p "$dir" && without_comments >"$dir/header" || exit 1
nm -g --defined-only "$library" | awk 'NF == 3 && $3 ~ /^_?hm_/ { print "symbol " $3 }' |
    awk "$among" | LC_ALL=C sort
# One declaration a line, names of arguments as they are.
sed -n '/^HM_API/,/;/p' "$dir/header" | tr '\n' ' ' | sed 's/;/;\n/g' |
    sed -n 's/  */ /g; s/^ *HM_API \(.*\);$/call \1/p' | LC_ALL=C sort
{
    for header in $headers; do echo "#include <${header##*/}>"; done
    echo '#include <stdio.h>'
    echo 'int main(void) {'
    awk -f c_api/packaging/table.awk $headers | awk '
        $1 == "constant" { printf "    printf(\"constant %s %%d\\n\", (int)%s);\n", $2, $2 }
        $1 == "struct" { printf "    printf(\"struct %s: %%d bytes\\n\", (int)sizeof(%s));\n", $2, $2 }
        $1 == "member" {
            printf "    printf(\"    %s: %%d, %%d bytes\\n\", (int)offsetof(%s, %s), (int)sizeof(((%s *)0)->%s));\n",
                $3, $2, $3, $2, $3
        }'
    cat <<'END'
    return 0;
}
END
} >"$dir/describe.c"
$CC -std=c99 -Iinclude -Ic_api -o "$dir/describe" "$dir/describe.c" && "$dir/describe"
