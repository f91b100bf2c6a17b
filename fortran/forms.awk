# usage: awk -v wanted=declarations|procedures -f forms.awk FORMS PART
# Writes the declarations or the procedures of one part of a module (join.sh says which lines of a part are replaced).
#
# A public call that takes arrays of several kinds and shapes has one body and a specific procedure for each form. The
# part has it once between !@forms NAME and !@end, with the line !@outcome behind the declarations of arguments:
#     subroutine morph_@FORM@(self, move, x, y, stat, err)        becomes morph_any, which contains the body, and
#         real(@KIND@), intent(inout), target :: x@SHAPE@         morph_v8, ..., which call it. In morph_any the
#         !@outcome                                               argument is type(any_array), integers are c_int32_t.
function of_form(text, k) {
    gsub(/@FORM@/, form[k], text)
    gsub(/@KIND@/, kind[k], text)
    gsub(/@SHAPE@/, shape[k], text)
    gsub(/@DIGIT@/, substr(form[k], length(form[k])), text)
    return text
}
# The declaration of arrays of any form in the procedure that has the body.
function of_any(declaration) {
    if (declaration ~ /integer\(@KIND@\)/) {
        sub(/@KIND@/, "c_int32_t", declaration)
        return declaration
    }
    sub(/real\(@KIND@\).*::/, "type(any_array), intent(in) ::", declaration)
    gsub(/@SHAPE@|\([:, ]*\)/, "", declaration)
    return declaration
}
# Notes how the specific procedure passes the arguments that this declaration of any form declares.
function note(declaration, one, m, j, array) {
    array = "array_of_v@DIGIT@("
    if (declaration ~ /\(:, :\)/) array = "array_of_b@DIGIT@("
    if (declaration ~ /@SHAPE@/) array = "array_of_@FORM@("
    if (declaration ~ /integer\(@KIND@\)/) array = "small("
    sub(/.*:: */, "", declaration)
    gsub(/@SHAPE@|\([:, ]*\)/, "", declaration)
    m = split(declaration, one, / *, */)
    for (j = 1; j <= m; ++j) passed[one[j]] = array one[j] ")"
}
# The call of the procedure that has the body, in lines of at most 120 columns.
function call_of(header, arguments, callee, m, j, word, line, lines) {
    gsub(/&\n */, "", header)
    match(header, /subroutine [^(]*\(/)
    callee = substr(header, RSTART + 11, RLENGTH - 12)
    sub(/@FORM@/, "any", callee)
    arguments = substr(header, RSTART + RLENGTH)
    sub(/\).*/, "", arguments)
    m = split(arguments, word, / *, */)
    line = "        call " callee "("
    for (j = 1; j <= m; ++j) {
        arguments = (word[j] in passed ? passed[word[j]] : word[j]) (j < m ? ", " : ")")
        if (length(line arguments) > 116) {
            lines = lines line "&\n"
            line = "            "
        }
        line = line arguments
    }
    return lines line "\n"
}
function finish_forms(k) {
    for (k = 1; k <= n; ++k) {
        if (name[k] != each) continue
        printf "\n%s", of_form(header declared outcome_arguments call_of(header) "    end subroutine\n", k)
    }
}
BEGIN {
    outcome_arguments = "        integer, intent(out), optional :: stat\n" \
        "        type(hm_error), intent(inout), optional :: err\n"
    legacy_call = "    use harmorph77\n    implicit none\n    real(c_double), intent(inout), target :: w(*)\n" \
        "    integer, intent(out) :: ierr\n    character(len=*), intent(inout) :: msg\n    type(legacy_call) :: this\n"
    outcome = outcome_arguments "        type(outcome) :: done\n"
}
FILENAME == ARGV[1] { name[++n] = $1; form[n] = $2; kind[n] = $3; shape[n] = $4; next }
FNR == 1 { section = "declarations" }
/^contains$/ { section = "procedures"; next }
section != wanted { next }
/^!@headers$/ { print ENVIRON["declared"]; next }
/^!@calls$/ { print ENVIRON["calls"]; next }
/^!@signatures$/ { print ENVIRON["signatures"]; next }
/^!@each / { each = $2; text = ""; next }
/^!@forms / { each = $2; in_forms = 1; next }
/^!@end$/ && !in_forms {
    for (k = 1; k <= n; ++k) if (name[k] == each) printf "%s", of_form(text, k)
    each = ""
    next
}
/^!@end$/ { each = in_forms = ""; next }
each && !in_forms { if (/^ *!@outcome$/) text = text outcome; else text = text $0 "\n"; next }
# A procedure of several forms: its header, its arguments, and its body.
in_forms && /^    subroutine .*@FORM@/ { header = any = ""; in_header = 1 }
in_forms && in_header {
    header = header $0 "\n"
    any = $0
    sub(/@FORM@/, "any", any)
    print any
    in_header = /&$/
    declared = ""
    in_arguments = !in_header
    next
}
in_forms && in_arguments && /^ *!@outcome$/ { printf "%s", outcome; in_arguments = 0; next }
in_forms && in_arguments {
    declared = declared $0 "\n"
    any = $0
    if (any ~ /@KIND@/) {
        note(any)
        any = of_any(any)
    }
    print any
    next
}
in_forms && /^    end subroutine$/ { print; finish_forms(); split("", passed); next }
/^ *!@outcome$/ { printf "%s", outcome; next }
/^ *!@call$/ { printf "%s", legacy_call; next }
{ print }
