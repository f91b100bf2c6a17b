# usage: awk -f join.awk c_api/web/package/errors.js ... >package.js
# Joins modules of the package, each after those that it imports from, into one script for pages: the constant
# `harmorph`, an object of what the modules export.
function end_module() {
    if (name != "") print "return {" exported " }; })();"
}
FNR == 1 {
    end_module()
    name = FILENAME
    sub(/.*\//, "", name)
    sub(/\.js$/, "", name)
    exported = ""
    printf "%s%s = (() => {\n", (NR == 1 ? "\"use strict\";\nconst harmorph = {};\n" : ""), "harmorph." name
}
/^import / {
    sub(/^import /, "const ")
    sub(/ from ".\//, " = harmorph.")
    sub(/\.js";/, ";")
    print
    next
}
/^export / {
    sub(/^export /, "")
    split($0, word, /[ (]/)
    exported = exported (exported == "" ? " " : ", ") word[2]
}
{ print }
END { end_module() }
