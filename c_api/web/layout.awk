# usage: awk -f c_api/packaging/table.awk include/harmorph.h ... | awk -f c_api/web/layout.awk
# Writes the table of c_api/web/module.cpp: constants, structs and members of the C headers by name, so that JavaScript
# reads and writes structs of the library without numbers of its own.
$1 == "constant" { printf "{\"%s\", \"constant\", %s, 0},\n", $2, $3 }
$1 == "struct" { printf "{\"%s\", \"struct\", sizeof(%s), 0},\n", $2, $2 }
$1 == "member" { printf "{\"%s\", \"%s\", offsetof(%s, %s), %s},\n", $3, $4, $2, $3, $5 }
