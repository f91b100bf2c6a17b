# usage: awk -f table.awk include/harmorph.h ...
# Writes what the C headers declare as a table, one line each, in the order of the headers:
#     constant NAME VALUE          an enumerator with its value, and HM_ABI
#     text NAME "TEXT"             HM_VERSION
#     struct NAME
#     about STRUCT TEXT            a line of the comment in front of the struct, or of the members that follow
#     member STRUCT NAME TYPE N    TYPE: int32, int64, size, double, char, pointer, function or a struct; N: array length
#     end STRUCT
#     comment TEXT                 a line of the comment in front of the next call
#     call NAME RESULT             RESULT: a type as of an argument, or void
#     argument NAME ARGUMENT TYPE STARS CONST
#                                  TYPE: as in C, without const; STARS: the number of *; CONST: 1 if there is a const
#     close NAME
# The Fortran module, the test of layouts and tests/release/abi/interface.txt are made from this table, and
# tests/program/cli/options.sh looks for an option of the program for each field, so that a new constant or member is one edit of a header. A
# declaration that this script does not understand ends the script with an error.
function fail(what) {
    print FILENAME ": " what > "/dev/stderr"
    failed = 1
    exit 1
}
# The line without comments; a comment may go on in the next line.
function without_comments(line, start, text) {
    text = ""
    while (line != "") {
        if (in_comment) {
            start = index(line, "*/")
            said_line(start ? substr(line, 1, start - 1) : line)
            if (!start) return text
            line = substr(line, start + 2)
            in_comment = 0
        } else {
            if (!(start = index(line, "/*"))) return text line
            text = text substr(line, 1, start - 1) " "
            line = substr(line, start + 2)
            in_comment = 1
        }
    }
    return text
}
# Keeps a line of a comment, which belongs to the next call or struct unless an empty line comes first, or to the
# members in front of the comment and on its line.
function said_line(text) {
    gsub(/^[ *]+|[ *]+$/, "", text)
    if (text != "") said[++n_said] = text
}
function constants(text, n, k, one, pair) {
    sub(/^[^{]*[{]/, "", text)
    n = split(text, one, ",")
    for (k = 1; k <= n; ++k) {
        gsub(/ /, "", one[k])
        if (one[k] == "") continue
        if (split(one[k], pair, "=") != 2 || pair[2] !~ /^(-?[0-9]+|INT32_MIN)$/)
            fail("the constant " one[k] " has no value that is a plain number")
        print "constant", pair[1], pair[2]
    }
}
function about(struct, k) {
    for (k = 1; k <= n_said; ++k) print "about", struct, said[k]
    n_said = 0
}
# Takes a line of the body of a struct. The members and their comments are written once both have ended.
function struct_line(text, n, k, one) {
    declared = declared " " text
    if (in_comment || declared !~ /[;}]/) return
    gsub(/[ \t]+/, " ", declared)
    n = split(declared, one, ";")
    about(struct)
    for (k = 1; k <= n && one[k] !~ /[}]/; ++k) members(struct, one[k])
    if (k <= n) {
        print "end", struct
        struct_type[struct] = 1
        struct = ""
    }
    declared = ""
}
# Members of one type: "const double *x, *y", "int32_t worst[5]".
function members(struct, declaration, n, k, name, type, length_of) {
    sub(/^ */, "", declaration)
    if (declaration == "") return
    n = split(declaration, name, ",")
    type = name[1]
    sub(/^const /, "", type)
    sub(/[ *].*/, "", type)
    sub(/^.*[ *]/, "", name[1])
    for (k = 1; k <= n; ++k) {
        length_of = 1
        if (match(name[k], /\[[0-9]+\]/)) {
            length_of = substr(name[k], RSTART + 1, RLENGTH - 2)
            sub(/\[.*/, "", name[k])
        }
        gsub(/[ *]/, "", name[k])
        if (name[k] !~ /^[a-z][a-z0-9_]*$/) fail("the member \"" declaration "\" of " struct " has an unknown form")
        print "member", struct, name[k], kind_of(declaration, type), length_of
    }
}
# The call "hm_status hm_morph(const hm_basis* basis, ...)". Calls for communicators of C are left out: other languages
# have the same calls with an MPI_Fint.
function call(declaration, name, one, n, k, type, argument, stars) {
    sub(/^HM_API /, "", declaration)
    if (declaration ~ /MPI_Comm/) return
    name = type = declaration
    sub(/ ?\(.*/, "", name)
    sub(/^.*[ *]/, "", name)
    sub(/^const /, "", type)
    sub(/[ *].*/, "", type)
    for (k = 1; k <= n_said; ++k) print "comment", said[k]
    print "call", name, type
    sub(/^[^(]*\(/, "", declaration)
    sub(/\).*/, "", declaration)
    n = declaration == "void" ? 0 : split(declaration, one, ",")
    for (k = 1; k <= n; ++k) {
        argument = one[k]
        stars = gsub(/\*/, " ", argument)
        type = argument
        sub(/ *$/, "", argument)
        sub(/^.* /, "", argument)
        gsub(/^ *(const )? */, "", type)
        sub(/ .*/, "", type)
        print "argument", name, argument, type, stars, (one[k] ~ /const /) + 0
    }
    print "close", name
}
function kind_of(declaration, type) {
    if (declaration ~ /\*/) return "pointer"
    if (type in function_type) return "function"
    if (type == "int32_t" || type == "hm_status") return "int32"
    if (type == "int64_t" || type == "uint64_t") return "int64"
    if (type == "size_t") return "size"
    if (type == "double" || type == "char" || type in struct_type) return type
    fail("the type of \"" declaration "\" is unknown")
}
/^#define HM_ABI / { print "constant HM_ABI", $3 }
/^#define HM_VERSION / { print "text HM_VERSION", $3 }
/^#/ || (/^ *$/ && statement !~ /[^ ]/) { n_said = 0 }
/^#/ || /^extern "C" [{]/ || /^[}]$/ { next }
struct != "" {
    struct_line(without_comments($0))
    next
}
/^typedef struct [a-z_]+ [{]/ {
    struct = $3
    print "struct", struct
    about(struct)
    sub(/^[^{]*[{]/, "")
    struct_line(without_comments($0))
    next
}
{
    statement = statement " " without_comments($0)
    if (statement !~ /;/ || (statement ~ /[{]/ && statement !~ /[}]/)) next     # it goes on in the next line
    gsub(/[ \t]+/, " ", statement)
    sub(/^ /, "", statement)
    if (statement ~ /^enum [a-z_]*[{]|^enum [{]/) {
        sub(/[}].*/, "", statement)
        constants(statement)
    } else if (statement ~ /^typedef [a-z0-9_]+ ?\(\*[a-z_]+\)/) {
        sub(/^[^*]*\*/, "", statement)
        sub(/\).*/, "", statement)
        function_type[statement] = 1
    } else if (statement ~ /^(HM_API )?(const )?[a-z0-9_]+ ?\*? ?hm_[a-z0-9_]+\(/) {
        call(statement)
    }
    statement = ""
    n_said = 0
}
END { if (!failed && (in_comment || struct != "" || statement ~ /[^ ]/)) fail("the header ends inside a declaration") }
