#!/bin/sh
# Tests of mesh files: sh tests/program/formats.sh path/to/harmorph folder/for/output [PART...]
# A part is a file of tests/program/formats, without its .sh; none: all of them.
if [ $# -lt 2 ]; then
    echo "usage: sh tests/program/formats.sh HARMORPH OUTPUT [PART...]" >&2
    exit 2
fi
harmorph=$1 tmp=$2/formats-test
: "${CXX:=c++}"
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2
topic="mesh files" log=$tmp/out
. "$(dirname "$0")/../count.sh"

says() { # says NAME TEXT: the last command checked, on either output
    if grep -F -e "$2" "$tmp/out" >/dev/null; then ok "$1"; else fail "$1: does not say '$2'"; fi
}
refuses() { # refuses NAME TEXT COMMAND...: exit code 3, and the message contains the text
    name=$1 text=$2; shift 2
    "$@" >"$tmp/out" 2>&1
    code=$?
    if [ $code -eq 3 ] && grep -F -e "$text" "$tmp/out" >/dev/null; then ok "$name"; else
        fail "$name: exit code $code, does not say '$text'"
        sed 's/^/     | /' "$tmp/out" | head -5
    fi
}
alike() { # alike TOLERANCE A B: all numbers of two files are the same to this tolerance, all else is the same
    awk -v eps="$1" 'NR == FNR { line[FNR] = $0; n = FNR; next }
        { m = split(line[FNR], a); if (m != NF) exit 1
          for (k = 1; k <= NF; k++) {
              d = a[k] - $k
              is_text = a[k] + 0 == 0 && a[k] !~ /^[-+.0-9e]*$/
              if (d > eps || -d > eps || (is_text && a[k] "" != $k "")) { bad = 1; exit } } }
        END { exit bad || FNR != n }' "$2" "$3"
}
# morphs WHAT MESH BODY [OPTIONS of solve...]: fit, solve, morph without and with movements; leaves $moved.
morphs() {
    name=$1 given=$2 body=$3 moved=$(dirname "$2")/moved-$(basename "$2"); shift 3
    check "$name: check" "$harmorph" check "$given"
    check "$name: fit" "$harmorph" fit "$given" --marker "$body" --points 8 -o "$tmp/curve"
    check "$name: solve" "$harmorph" solve "$given" --curve "$body=$tmp/curve" "$@" -o "$tmp/basis"
    check "$name: zero move" "$harmorph" morph "$given" "$tmp/basis" --move "$tmp/none.txt" -o "$moved"
    check "$name: zero move: the same file" cmp "$given" "$moved"
    check "$name: morph" "$harmorph" morph "$given" "$tmp/basis" --move "$tmp/moves.txt" -o "$moved"
    check "$name: morph: another file" sh -c "! cmp -s '$given' '$moved'"
    check "$name: check the morphed" "$harmorph" check "$moved"
}
body_of() { # the markers of the ring's inner circle, with commas
    "$harmorph" check "$@" --json 2>/dev/null | grep -o '"name": "[^"]*"' | sed 's/.*: "//; s/"//' |
        grep -E '^(body|zone:16|1|boundary1|[0-9]:[jk]min)$' | paste -s -d , -
}

has_zlib() { grep -e '-lz' "$(dirname "$harmorph")/objects/program.list" >/dev/null 2>&1; }

for name in make_mesh make_foam; do
    printf '#!/bin/sh\nPYTHONDONTWRITEBYTECODE=1 exec "%s" "%s" "$@"\n' "${PYTHON:-/usr/bin/python3}" \
        "$(pwd)/tests/program/formats/$name.py" >"$tmp/$name"
    chmod +x "$tmp/$name"
done
make_mesh=$tmp/make_mesh
awk 'BEGIN { for (i = 1; i <= 8; i++) print i, .3, .1 }' >"$tmp/moves.txt"
echo "# nothing moves" >"$tmp/none.txt"
check "make_mesh runs" "$make_mesh" list
for kind in $("$make_mesh" list); do "$make_mesh" $kind "$tmp/$kind"; done
# The plain file, morphed: what all formats have to agree with.
cp "$tmp/plain.su2" "$tmp/ring.su2"
check "plain.su2: fit" "$harmorph" fit "$tmp/ring.su2" --marker body --points 8 -o "$tmp/curve"
check "plain.su2: solve" "$harmorph" solve "$tmp/ring.su2" --curve "body=$tmp/curve" -o "$tmp/basis"
check "plain.su2: morph" "$harmorph" morph "$tmp/ring.su2" "$tmp/basis" --move "$tmp/moves.txt" \
    -o "$tmp/moved-plain.su2"
points_of() { sed '1,/^NPOIN/d; /^NMARK/,$d' "$1" | awk '{ print $1, $2 }'; }
points_of "$tmp/moved-plain.su2" >"$tmp/points-of-all"

# The program may take 256 MiB, most of which is the program itself, and no more than 60 s of the processor, of which it
# needs a thousandth.
claims() { # claims NAME FILE: the program refuses the file, or reads it, within these bounds
    (ulimit -v 262144 && ulimit -t 60 && exec "$harmorph" check "$2") >"$tmp/out" 2>&1
    code=$?
    case $code in 0 | 1 | 3)
        if grep -e 'bad_alloc' -e 'length_error' -e 'out of memory' "$tmp/out" >/dev/null || {
            [ $code -ne 0 ] && ! grep -F -e "$tmp" "$tmp/out" >/dev/null; }; then
            fail "claims: $1: $(head -n 1 "$tmp/out")"
        else ok "claims: $1"; fi ;;
    *) fail "claims: $1: exit code $code: $(head -n 1 "$tmp/out")" ;;
    esac
}
# claim FILE SED NEW: a small change of a file that is read otherwise
big=2147483647
claim() {
    mkdir -p "$tmp/claim"
    sed "$2" "$tmp/$1" >"$tmp/claim/$1"
    if cmp -s "$tmp/$1" "$tmp/claim/$1"; then fail "claims: $1: '$2' changes nothing"; else
        claims "$1: $2" "$tmp/claim/$1"; fi
}

shift 2
for part in ${*:-$(ls tests/program/formats/*.sh | sed 's|.*/||; s|\.sh$||')}; do
    . "tests/program/formats/$part.sh"
done
finish
