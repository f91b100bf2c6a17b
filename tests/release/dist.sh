#!/bin/sh
# usage: dist.sh BUILD   (MAKE from the environment)
# The tarball of the sources is the same, byte for byte, when it is made twice and when it is made from itself. The
# manual page has every command and every option, and groff takes it without a warning.
: "${MAKE:=make}"
build=$(cd "$1" && pwd)
dir=$build/dist-test
topic=distribution log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir"
mkdir -p "$dir/first" "$dir/second"
name=harmorph-$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
other_versions() {   # files of a release whose version is not that of the header
    packaging=c_api/packaging
    sed -n 's/^## \([0-9.]*\).*/CHANGELOG.md \1/p' $packaging/CHANGELOG.md | head -1
    sed -n 's/^version: /CITATION.cff /p' $packaging/CITATION.cff
    sed -n '1s/harmorph (\(.*\)-.*/debian \1/p' $packaging/debian/changelog
}
is_empty "the version of the release elsewhere" "$(other_versions | grep -vx ".* ${name#harmorph-}")"
check "files that name the version" test "$(other_versions | wc -l)" = 3
dates() {
    sed -n 's/^## [0-9.]* (\([0-9-]*\)).*/\1/p' c_api/packaging/CHANGELOG.md | head -1
    sed -n 's/^date-released: //p' c_api/packaging/CITATION.cff
    sed -n 's/^ -- .*, \([0-9]*\) \([A-Z][a-z]*\) \([0-9]*\) .*/\3 \2 \1/p' c_api/packaging/debian/changelog | head -1 |
        awk '{ printf "%d-%02d-%02d\n", $1, (index("JanFebMarAprMayJunJulAugSepOctNovDec", $2) + 2) / 3, $3 }'
}
check "dates of the release" test "$(dates | wc -l) $(dates | sort -u | wc -l)" = "3 1"
if tar --version 2>/dev/null | grep -q GNU; then
    check "make dist" $MAKE -s BUILD="$dir/first" dist
    check "make dist, at another time and by another mask of permissions" sh -c 'umask 077; sleep 1; exec "$@"' sh \
        $MAKE -s BUILD="$dir/second" dist
    check "the same bytes" cmp "$dir/first/$name.tar.gz" "$dir/second/$name.tar.gz"
    check "unpacking" tar xzf "$dir/first/$name.tar.gz" -C "$dir"
    check "make dist in the unpacked tarball" sh -c 'cd "$1" && $2 -s BUILD="$1/build" dist' sh "$dir/$name" "$MAKE"
    check "the same bytes again" cmp "$dir/first/$name.tar.gz" "$dir/$name/build/$name.tar.gz"
    check "the rules of the unpacked Makefile" sh -c 'cd "$1" && $2 -s BUILD="$1/build" rules' sh "$dir/$name" "$MAKE"
else
    skip "the tarball" "tar is not GNU's"
fi

check "make manual" $MAKE -s BUILD="$build" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS" manual
options_missing() {   # every word that begins an option's line in the help of a command
    "$build/harmorph" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' | while read -r command; do
        grep -qx ".SS harmorph $command" "$build/harmorph.1" || echo "$command"
        "$build/harmorph" "$command" --help | sed -n 's/^  \(-[-a-z]*\).*/\1/p' | while read -r option; do
            sed 's/\\-/-/g' "$build/harmorph.1" | grep -q "^\.B $option\b" || echo "$command $option"
        done
    done
}
nothing_missing() { ! options_missing | grep .; }
check "commands and options in the manual page" nothing_missing
completed() {   # WORD...: what bash offers for the last word
    bash -c '. "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _harmorph
        printf "%s\n" "${COMPREPLY[@]}"' bash "$build/harmorph.bash" harmorph "$@"
}
not_completed() {   # the words of every help, of which the completion offers others
    "$build/harmorph" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' | sort >"$dir/words"
    completed '' | sed '/^-/d; /^help$/d' | sort | diff "$dir/words" - || echo "names of commands"
    while read -r command; do
        "$build/harmorph" "$command" --help | sed -n 's/^  \(-[-a-z]*\).*/\1/p' | sort >"$dir/options"
        completed "$command" - | sort | diff "$dir/options" - || echo "options of $command"
    done <"$dir/words"
}
nothing_differs() { ! not_completed | grep .; }
if command -v bash >/dev/null; then
    check "commands and options in the completion" nothing_differs
    check "completion of a name of a file" test "$(completed check c_api/cli/completion.s)" = c_api/cli/completion.sh
else
    skip "the completion" "bash is not installed"
fi
quietly() { ! "$@" 2>&1 | grep .; }
if command -v groff >/dev/null; then
    check "groff's judgement of the manual page" quietly groff -man -ww -z "$build/harmorph.1"
else
    skip "the setting of the manual page" "groff is not installed"
fi
finish "$dir"
