# usage: awk [-v layout=c|fortran] -f type_of.awk -f declarations.awk TABLE
# Writes what Fortran declares of the constants and structs in TABLE, which c_api/packaging/table.awk makes from the C
# headers: parameters with the names of the constants, and a bind(C) type for each struct (type_of.awk has the names)
# with the comments of the header, whose component struct_size has the right value from the beginning.
# With layout=c and layout=fortran: the two sides of the comparison in layout.c and layout.f90 of tests/fortran.
# The bytes of a struct, with pointers of 8 and of 4 bytes, as compilers of C place the members.
function begin_struct(pointer) {
    for (pointer = 4; pointer <= 8; pointer += 4) bytes[pointer] = align[pointer] = 0
}
function add_member(type, n, pointer, one, all) {
    for (pointer = 4; pointer <= 8; pointer += 4) {
        one = type ~ /^(pointer|function|size)$/ ? pointer : type in number_bytes ? number_bytes[type] : \
            size[type, pointer]
        all = type in number_bytes || !((type, pointer) in alignment) ? one : alignment[type, pointer]
        if (all > align[pointer]) align[pointer] = all
        bytes[pointer] = padded(bytes[pointer], all) + n * one
    }
}
function end_struct(struct, pointer) {
    for (pointer = 4; pointer <= 8; pointer += 4) {
        alignment[struct, pointer] = align[pointer]
        size[struct, pointer] = padded(bytes[pointer], align[pointer])
    }
}
function padded(n, to) { return n % to ? n + to - n % to : n }
BEGIN {
    number_bytes["char"] = 1
    number_bytes["int32"] = 4
    number_bytes["int64"] = number_bytes["double"] = 8
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
layout == "" && $1 == "constant" && $3 != "INT32_MIN" {
    print "    integer, parameter, public :: " tolower($2) " = " $3
}
layout == "" && $1 == "constant" && $3 == "INT32_MIN" {
    print "    integer(c_int32_t), parameter, public :: " tolower($2) " = -huge(0_c_int32_t) - 1_c_int32_t"
}
layout == "" && $1 == "struct" { lines = "\n    type, bind(c), public :: " type_of($2) "\n"; begin_struct() }
layout == "" && $1 == "about" {
    sub(/^about [a-z_]+ /, "")
    lines = lines "        ! " $0 "\n"
}
layout == "" && $1 == "member" {
    line = $4 in declaration ? declaration[$4] : "type(" type_of($4) ") :: #@"
    sub(/#/, $3, line)
    sub(/@/, $5 > 1 ? "(" $5 ")" : "", line)
    if ($3 == "struct_size") sub(/= 0/, "= SIZE", line)
    lines = lines "        " line "\n"
    add_member($4, $5)
}
layout == "" && $1 == "end" {
    end_struct($2)
    if (size[$2, 8] == size[$2, 4]) sub(/SIZE/, size[$2, 8], lines)
    else sub(/SIZE/, "merge(" size[$2, 8] ", " size[$2, 4] ", storage_size(c_null_ptr) == 64)", lines)
    if (!is_output) print lines "    end type\n"
}

layout != "" && $1 == "constant" { constant[++n_constants] = $2 }
layout == "c" && $1 == "struct" { print "    case " ++n_structs ":\n        PUT(sizeof(" $2 "));" }
layout == "c" && $1 == "member" { print "        PUT(offsetof(" $2 ", " $3 "));" }
layout == "c" && $1 == "end" { print "        break;" }
layout == "fortran" && $1 == "struct" {
    print "    block\n        type(" type_of($2) "), target :: object"
    call = sprintf("        call compare(\"%s\", %d, c_sizeof(object), c_loc(object), [", $2, ++n_structs)
    has_size = ""
    comma = ""
}
layout == "fortran" && $1 == "member" {
    call = call comma " &\n            c_loc(object%" $3 ")"
    if ($3 == "struct_size") has_size = "        call compare_size(\"" $2 "\", object%struct_size, c_sizeof(object))\n"
    comma = ","
}
layout == "fortran" && $1 == "end" { print call "])\n" has_size "    end block" }
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
