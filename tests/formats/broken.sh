# Damaged files are refused, or read: never more. (A part of tests/formats.sh.)
# As one file, so that the headers that they share are read once.
for source in c_api/cli/formats/*.cpp c_api/cli/basics/csv_cells.cpp c_api/cli/basics/text_file.cpp \
    c_api/cli/basics/numbers.cpp \
    c_api/cli/basics/decimals.cpp c_api/cli/basics/mapped_file.cpp c_api/cli/basics/ordered_output.cpp \
    c_api/cli/basics/tasks.cpp c_api/cli/basics/large_arrays.cpp \
    c_api/cli/mesh/mesh_file.cpp c_api/cli/mesh/boundary_loops.cpp c_api/cli/basics/output_file.cpp \
    c_api/cli/basics/temporary_files.cpp c_api/cli/basics/readable.cpp \
    c_api/cli/mesh/one_cell_thick.cpp c_api/cli/mesh/cell_faces.cpp \
    c_api/cli/mesh/space_mesh.cpp; do
    echo "#include \"$source\""
done >"$tmp/readers.cpp"
library=$(dirname "$harmorph")/libharmorph.a
zlib= library_of_zlib=
if has_zlib; then zlib=-DHARMORPH_ZLIB library_of_zlib=-lz; fi
sanitize="-fsanitize=address,undefined -fno-sanitize-recover=all"
if echo 'int main() {}' | $CXX $sanitize -x c++ - -o "$tmp/empty" 2>/dev/null && "$tmp/empty" 2>/dev/null; then :; else
    echo "the compiler has no sanitizers: broken files are read without"
    sanitize=
fi
check "mutate is compiled" $CXX -std=c++17 -pthread -O0 $sanitize $zlib -I. -Iinclude -Ic_api/cli -o "$tmp/mutate" \
    tests/formats/mutate.cpp "$tmp/readers.cpp" "$library" $library_of_zlib
for storage in text binary-64; do "$tmp/make_foam" "$tmp/broken-$storage" $storage wedge; done
files=$(cd "$tmp" && { ./make_mesh list; ls broken-*/constant/polyMesh/[pfob]*; } | tr '\n' ' ')
check "broken files are refused, or read: never more" sh -c "cd '$tmp' && ./mutate broken 120 $files"
cat "$tmp/out"
