# Damaged files are refused, or read: never more. (A part of tests/program/formats.sh.)
# As one file, so that the headers that they share are read once: the sources that the Python package compiles.
PYTHONPATH=c_api/python/native PYTHONDONTWRITEBYTECODE=1 "${PYTHON:-/usr/bin/python3}" -c '
import reader_sources
for path in reader_sources.reader_sources("c_api/cli"):
    if path.suffix == ".cpp":
        print("#include \"" + str(path) + "\"")' >"$tmp/readers.cpp"
library=$(dirname "$harmorph")/libharmorph.a
zlib= library_of_zlib=
if has_zlib; then zlib=-DHARMORPH_ZLIB library_of_zlib=-lz; fi
sanitize="-fsanitize=address,undefined -fno-sanitize-recover=all"
if echo 'int main() {}' | $CXX $sanitize -x c++ - -o "$tmp/empty" 2>/dev/null && "$tmp/empty" 2>/dev/null; then :; else
    echo "the compiler has no sanitizers: broken files are read without"
    sanitize=
fi
check "mutate is compiled" $CXX -std=c++17 -pthread -O0 $sanitize $zlib -I. -Iinclude -Ic_api/cli -o "$tmp/mutate" \
    tests/program/formats/mutate.cpp "$tmp/readers.cpp" "$library" $library_of_zlib
for storage in text binary-64; do "$tmp/make_foam" "$tmp/broken-$storage" $storage wedge; done
files=$(cd "$tmp" && { ./make_mesh list; ls broken-*/constant/polyMesh/[pfob]*; } | tr '\n' ' ')
check "broken files are refused, or read: never more" sh -c "cd '$tmp' && ./mutate broken 120 $files"
cat "$tmp/out"
