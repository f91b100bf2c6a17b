# usage: awk -f type_of.awk -f interfaces.awk arguments TABLE
# Writes an interface, with the comment of the header, for each call in TABLE, which c_api/packaging/table.awk makes
# from the C headers. The function hm_morph of C becomes hm_c_morph. TABLE says what is a number and what is a pointer;
# the file `arguments` says which pointers are arrays, and which may be null. Calls for MPI and PETSc are private.
function form_of(call, argument, type) {
    if (type == "hm_error" || type == "size_t" || type == "int64_t") return "one"
    if (type == "hm_executor" || type == "void" || !(type in number || type in is_struct)) return "address"
    if ((call, argument) in form) return form[call, argument]
    if (("*", argument) in form) return form["*", argument]
    return type in is_struct ? "one" : "many"
}
function declaration_of(call, argument, type, stars, is_const, passed) {
    if (stars == 2) return "type(c_ptr), intent(inout) :: " argument
    if (stars == 0) return number[type] ", value, intent(in) :: " argument
    passed = form_of(call, argument, type)
    if (passed == "address") return "type(c_ptr), value, intent(in) :: " argument
    type = type in number ? number[type] : "type(" type_of(type) ")"
    return type ", intent(" (is_const ? "in" : "inout") ") :: " argument (passed == "many" ? "(*)" : "")
}
# The text in lines of at most 120 columns.
function wrapped(text, line, n, k, word, lines) {
    n = split(text, word, " ")
    line = word[1]
    for (k = 2; k <= n; ++k) {
        if (length(line " " word[k]) > 108) {
            lines = lines line " &\n            "
            line = "    " word[k]
        } else {
            line = line " " word[k]
        }
    }
    return lines line
}
BEGIN {
    number["int32_t"] = number["hm_status"] = "integer(c_int32_t)"
    number["int64_t"] = number["uint64_t"] = "integer(c_int64_t)"
    number["size_t"] = "integer(c_size_t)"
    number["uint8_t"] = "integer(c_int8_t)"
    number["MPI_Fint"] = number["int"] = "integer(c_int)"
    number["double"] = "real(c_double)"
    result["char"] = "type(c_ptr)"
    print "    interface"
}
FILENAME ~ /arguments$/ {
    if ($1 != "#") for (k = 3; k <= NF; ++k) form[$2, $k] = $1
    next
}
$1 == "struct" || $1 == "known" { is_struct[$2] = 1 }
$1 == "comment" {
    sub(/^comment /, "")
    comment = comment "        ! " $0 "\n"
}
$1 == "call" {
    name = $2
    sub(/^hm_/, "hm_c_", name)
    sub(/_f$/, "", name)
    returned = $3 == "void" ? "" : $3 in number ? number[$3] : result[$3]
    arguments = declared = ""
}
$1 == "argument" {
    arguments = arguments (arguments == "" ? "" : ", ") $3
    declared = declared "            " declaration_of($2, $3, $4, $5, $6) "\n"
}
$1 == "close" && $2 != "hm_init" {
    kind = returned == "" ? "subroutine" : "function"
    printf "%s        %s\n", comment, wrapped((returned == "" ? "" : returned " ") kind " " name "(" arguments \
        ") bind(c,name=\"" $2 "\")")
    printf "            import\n%s        end %s\n", declared, kind
    if (name !~ /^hm_c_(mpi|petsc)_/) names[++n_names] = name
}
$1 == "close" { comment = "" }
END {
    print "    end interface"
    for (k = 1; k <= n_names; ++k) print "    public :: " names[k]
}
