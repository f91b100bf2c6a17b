#!/bin/sh
# usage: describe.sh LIBRARY DIR   (CC from the environment; in the top directory)
# The binary interface of the C headers and the library, as text: exported calls with their declarations, structs with
# the places and sizes of all fields, constants. The headers themselves are taken apart:
# nothing of them can be forgotten here.
: "${CC:=cc}"
library=$1 dir=$2
headers=$(grep -l '^HM_API' include/*.h)
without_comments() { cat $headers | tr '\n' '~' | sed 's|/\*[^*]*\**\([^/*][^*]*\**\)*\*/||g' | tr '~' '\n'; }
mkdir -p "$dir" && without_comments >"$dir/header" || exit 1
nm -g --defined-only "$library" | awk 'NF == 3 && $3 ~ /^_?hm_/ { print "symbol " $3 }' | LC_ALL=C sort
# One declaration a line, names of arguments as they are.
sed -n '/^HM_API/,/;/p' "$dir/header" | tr '\n' ' ' | sed 's/;/;\n/g' |
    sed -n 's/  */ /g; s/^ *HM_API \(.*\);$/call \1/p' | LC_ALL=C sort
{
    for header in $headers; do echo "#include <${header#include/}>"; done
    echo '#include <stdio.h>'
    echo 'int main(void) {'
    awk '
    /^enum/ { constants = 1 }
    constants { text = text " " $0 }
    constants && /};/ {
        sub(/^[^{]*{/, "", text); sub(/};.*/, "", text)
        n = split(text, names, ",")
        for (k = 1; k <= n; ++k) {
            sub(/=.*/, "", names[k]); gsub(/ /, "", names[k])
            if (names[k] != "") printf "    printf(\"constant %s %%d\\n\", (int)%s);\n", names[k], names[k]
        }
        constants = 0; text = ""
    }
    /^typedef struct [a-z_]+ {/ {
        type = $3; fields = ""
        printf "    printf(\"struct %s: %%d bytes\\n\", (int)sizeof(%s));\n", type, type
        next
    }
    type != "" && /^}/ {
        n = split(fields, one, ";")
        for (k = 1; k <= n; ++k) {
            m = split(one[k], names, ",")
            for (j = 1; j <= m; ++j) {
                name = names[j]
                sub(/\[.*/, "", name); sub(/ *$/, "", name); sub(/.*[ *]/, "", name)
                if (name != "")
                    printf "    printf(\"    %s: %%d, %%d bytes\\n\", " \
                        "(int)offsetof(%s, %s), (int)sizeof(((%s *)0)->%s));\n",
                        name, type, name, type, name
            }
        }
        type = ""
        next
    }
    type != "" { fields = fields " " $0 }' "$dir/header"
    cat <<'END'
    printf("constant HM_ABI %d\n", HM_ABI);
    return 0;
}
END
} >"$dir/describe.c"
$CC -std=c99 -Iinclude -o "$dir/describe" "$dir/describe.c" && "$dir/describe"
