#!/bin/sh
# usage: join.sh MODULE >MODULE.f90   (HEADERS: the folder of the C headers, include/ if not set)
# Joins the parts in the folder MODULE to one source file, which users compile: a module of the parts that the file
# `order` names, and behind the module the parts that the file `after` names. Each part of a module has
# declarations, a line `contains`, and procedures; the first parts are the manual and the beginning of the module.
#
# The lines between !@each NAME and !@end are written once for each line of the file `forms` that begins with NAME; that
# line also gives the form, the kind and the shape. Between !@forms NAME and !@end are procedures that have one body for
# all forms (forms.awk). The line !@outcome declares stat, err and the outcome of a call of the module, !@call what all
# calls of FORTRAN 77 declare. The lines !@headers and !@calls stand for what the C headers in the list `headers`
# declare: constants and structs (declarations.awk), and functions (interfaces.awk); the line !@signatures for the
# arguments of all calls of the module (signatures.awk).
top=$(cd "$(dirname "$0")/.." && pwd)
headers=$(cd "${HEADERS:-$top/include}" && pwd)
cd "$top/fortran/$1" || exit 1
forms=/dev/null declared= calls=
[ ! -f forms ] || forms=forms
if [ -f headers ]; then
    table() { (cd "$headers" && awk -f "$top/c_api/packaging/table.awk" $(cat "$top/fortran/$1/headers")); }
    known=$(table harmorph) && table=$(table "$1") || exit 1
    declared=$(echo "$table" | awk -f ../type_of.awk -f ../declarations.awk) || exit 1
    calls=$({ echo "$known" | sed -n 's/^struct /known /p'; echo "$table"; } |
        awk -f ../type_of.awk -f ../interfaces.awk ../arguments -) || exit 1
fi
signatures=$(awk -f ../signatures.awk $(cat order)) || exit 1
export declared calls signatures
part() { awk -v wanted="$2" -f ../forms.awk $forms "$1" || exit 1; }   # file, declarations or procedures
for file in $(cat order); do part $file declarations; done
echo contains
for file in $(cat order); do part $file procedures; done
echo "end module"
[ ! -f after ] || for file in $(cat after); do part $file declarations; done
