# usage: awk [-v layout=c|fortran] -f type_of.awk -f declarations.awk TABLE
# Writes what Fortran declares of the constants and structs in TABLE, which c_api/packaging/table.awk makes from the C
# headers: parameters with the names of the constants, and a bind(C) type for each struct (type_of.awk has the names).
# With layout=c and layout=fortran: the two sides of the comparison in tests/layout.c and tests/layout.f90.
BEGIN {
    declaration["int32"] = "integer(c_int32_t) :: #@ = 0"
    declaration["int64"] = "integer(c_int64_t) :: #@ = 0"
    declaration["size"] = "integer(c_size_t) :: #@ = 0"
    declaration["double"] = "real(c_double) :: #@ = 0"
    declaration["char"] = "character(kind=c_char) :: #@ = c_null_char"
    declaration["pointer"] = "type(c_ptr) :: #@ = c_null_ptr"
    declaration["function"] = "type(c_funptr) :: #@ = c_null_funptr"
}
{ is_output = $2 ~ /_out$/ }
layout == "" && $1 == "text" { print "    character(len=*), parameter, public :: hm_header_version = " $3 }
layout == "" && $1 == "constant" && $3 != "INT32_MIN" { print "    integer, parameter, public :: " tolower($2) " = " $3 }
layout == "" && $1 == "constant" && $3 == "INT32_MIN" {
    print "    integer(c_int32_t), parameter, public :: " tolower($2) " = -huge(0_c_int32_t) - 1_c_int32_t"
}
layout == "" && $1 == "struct" && !is_output { print "\n    type, bind(c), public :: " type_of($2) }
layout == "" && $1 == "member" && !is_output {
    line = $4 in declaration ? declaration[$4] : "type(" type_of($4) ") :: #@"
    sub(/#/, $3, line)
    sub(/@/, $5 > 1 ? "(" $5 ")" : "", line)
    print "        " line
}
layout == "" && $1 == "end" && !is_output { print "    end type\n" }

layout != "" && $1 == "constant" { constant[++n_constants] = $2 }
layout == "c" && $1 == "struct" { print "    case " ++n_structs ":\n        PUT(sizeof(" $2 "));" }
layout == "c" && $1 == "member" { print "        PUT(offsetof(" $2 ", " $3 "));" }
layout == "c" && $1 == "end" { print "        break;" }
layout == "fortran" && $1 == "struct" {
    print "    block\n        type(" type_of($2) "), target :: object"
    printf "        call compare(\"%s\", %d, c_sizeof(object), c_loc(object), [", $2, ++n_structs
    comma = ""
}
layout == "fortran" && $1 == "member" {
    printf "%s &\n            c_loc(object%%%s)", comma, $3
    comma = ","
}
layout == "fortran" && $1 == "end" { print "])\n    end block" }
END {
    if (layout == "c") print "    case 0:"
    if (layout == "fortran") printf "    call compare_numbers(\"constants\", 0, int(["
    for (k = 1; k <= n_constants; ++k) {
        if (layout == "c") print "        PUT(" constant[k] ");"
        else printf "%s &\n        %s", (k > 1 ? "," : ""), tolower(constant[k])
    }
    if (layout == "c") print "        break;"
    if (layout == "fortran") print "], c_int64_t))"
}
