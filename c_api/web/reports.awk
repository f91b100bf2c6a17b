# usage: awk -f c_api/packaging/table.awk include/harmorph.h ... | awk -f c_api/web/reports.awk
# Writes the types of what calls report, in TypeScript: an interface for each struct that is a report, with the names
# that layout.js gives to the members.
function camel(name,    parts, n, k, text) {
    n = split(name, parts, "_")
    text = parts[1]
    for (k = 2; k <= n; ++k) text = text toupper(substr(parts[k], 1, 1)) substr(parts[k], 2)
    return text
}
function type_name(struct) {
    struct = camel(substr(struct, 4))
    return toupper(substr(struct, 1, 1)) substr(struct, 2)
}
BEGIN { print "// Made from the headers of the library, which describe the members, by reports.awk." }
$1 == "struct" {
    wanted = $2 ~ /(_report|_info|_worst_cell)$/
    if (wanted) print "\nexport interface " type_name($2) " {"
}
$1 == "member" && wanted && $4 != "pointer" && $3 != "struct_size" && $3 !~ /^reserved/ {
    type = $4 ~ /^hm_/ ? type_name($4) : $4 == "char" ? "string" : "number"
    if ($5 > 1 && $4 != "char") type = type "[]"
    print "    " camel($3) ": " type ";"
}
$1 == "end" && wanted { print "}" }
