# Wrong usage is exit code 2, a result that cannot be used 1, and what cannot be written 3.

runs "--help" 0 --help
check "--help names the commands" says 'harmorph help COMMAND'
for command in morph interpolate; do check "--help: the name $command stands alone" says "  $command  "; done
runs "--version" 0 --version
# Every page of the help fits 80 columns, and has all options once: a command reads each of them.
"$harmorph" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' >"$tmp/commands"
check "--help: all commands" test "$(wc -l <"$tmp/commands")" -eq \
    "$(ls "$here"/../../../c_api/cli/commands/cmd_*.cpp | wc -l)"
check "--help: at most 80 columns" sh -c '! "$1" --help | awk "length(\$0) > 80" | grep .' sh "$harmorph"
while read -r command; do
    runs "$command --help" 0 $command --help
    check "$command --help has an example" says "  harmorph $command "
    check "$command --help: at most 80 columns" sh -c '! awk "length(\$0) > 80" "$1" | grep .' sh "$tmp/out"
    check "$command --help: each option once" test -z "$(sed -n 's/^  \(-[-a-z]*\).*/\1/p' "$tmp/out" | sort | uniq -d)"
    for option in $(sed -n 's/^  \(--[-a-z]*\).*/\1/p' "$tmp/out"); do
        if [ "$option" = --paper ]; then continue; fi # sets others
        check "$command: its sources read $option" grep -qr "\"$option\"" "$here/../../../c_api/cli"
    done
done <"$tmp/commands"
refuses "no command" 2 'command is missing'
refuses "unknown command" 2 "'frobnicate'" frobnicate
refuses "unknown option" 2 "'--colour'" check --colour "$ring"
refuses "missing operand" 2 'MESH is missing' check
refuses "operand too many" 2 'too many' check "$ring" "$ring"
refuses "option without its value" 2 '--marker' fit "$ring" -o "$tmp/x" --marker
refuses "missing -o" 2 '-o is missing' fit "$ring" --marker body
refuses "a word for a number" 2 "'many'" fit "$ring" --marker body -o "$tmp/x" --points many
refuses "degree out of range" 2 '--degree' fit "$ring" --marker body -o "$tmp/x" --degree 6
refuses "unknown --closed" 2 '--closed' fit "$ring" --marker body -o "$tmp/x" --closed maybe
refuses "more control points than points" 2 '--points' fit "$ring" --marker body -o "$tmp/x" --points 49
refuses "unknown marker" 2 "'body', 'far'" fit "$ring" --marker wing -o "$tmp/x"
refuses "two separate pieces of boundary" 2 'separate' fit "$ring" --marker body,far -o "$tmp/x"

# A result that cannot be used.
refuses "a shift that inverts cells" 1 '--safe goes farther' morph "$ring" "$basis" --by 'shift body 2.8 0'
refuses "a body that leaves the domain" 1 "; marker 'body' would be outside the domain" morph "$ring" "$basis" \
    --by 'shift body 0 -40'
check "no safe morph is offered then" sh -c '! grep "safe goes farther" "$1"' sh "$tmp/err"
refuses "morph that inverts cells" 1 'inverted cells: 0.' morph "$ring" "$basis" --move "$tmp/large.txt" \
    -o "$tmp/large.su2" --json
leaves_nothing "morph that inverts cells: nothing written" "$tmp/large.su2"
has_keys "morph that inverts cells: JSON all the same" \
    inverted admissible_step boundary_step self_crossing boundary_error \
    min_quality mean_quality morph_seconds moved_curve
runs "morph that inverts cells, --force" 1 morph "$ring" "$basis" --move "$tmp/large.txt" -o "$tmp/large.su2" --force
check "--force writes" test -s "$tmp/large.su2"
refuses "check counts inverted cells" 1 'inverted' check "$tmp/large.su2"
refuses "solve refuses inverted cells" 3 "$tmp/large.su2:" solve "$tmp/large.su2" --curve body="$curve" -o "$tmp/x"
refuses "not converged" 1 'the solution has not converged: ' solve "$ring" --curve body="$curve" \
    -o "$tmp/loose.basis" --tol 1e-30
leaves_nothing "not converged: nothing written" "$tmp/loose.basis"
runs "not converged, --force" 1 solve "$ring" --curve body="$curve" \
    -o "$tmp/loose.basis" --tol 1e-30 --force
check "not converged, --force writes" test -s "$tmp/loose.basis"

# Output that cannot be written.
refuses "no such folder" 3 'no/such/folder' morph "$ring" "$basis" --move "$no_moves" -o "$tmp/no/such/folder/mesh.su2"
if [ -c /dev/full ]; then
    full='/dev/full: cannot be written: No space left on device'
    refuses "a full disk: the reason" 3 "$full" morph "$ring" "$basis" --move "$no_moves" -o /dev/full
    refuses "all files or none" 3 '/dev/full' morph "$ring" "$basis" --move "$no_moves" -o "$tmp/x" --vtu /dev/full
    leaves_nothing "all files or none: none" "$tmp/x"
    # A file of megabytes fails long before the end of the command, which then asks for other files.
    make_ring 400 60 >"$tmp/many.su2"
    makes solve "$tmp/many.su2" --curve body="$curve" -o "$tmp/many.basis"
    refuses "a full disk, found out early: the reason" 3 "$full" \
        morph "$tmp/many.su2" "$tmp/many.basis" --move "$no_moves" -o /dev/full --vtu "$tmp/x"
    "$harmorph" check "$ring" >/dev/full 2>/dev/null
    check "standard output on a full disk" test $? -eq 3
fi

# Nobody reads what a command says: the files are written all the same.
rm -f "$tmp/closed.su2"
"$harmorph" morph "$ring" "$basis" --move "$no_moves" -o "$tmp/closed.su2" >&- 2>"$tmp/err"
check "a closed standard output: exit code" test $? -eq 0
check "a closed standard output: the mesh" cmp "$ring" "$tmp/closed.su2"
"$harmorph" check "$ring" >&- 2>"$tmp/err"
check "a closed standard output of a command without files" test $? -eq 3

# What a new user types.
for words in "help" "-h" "--help"; do
    runs "$words" 0 $words
    check "$words: demo is the first command" sh -c "sed -n '/^Commands:/{n;p;}' '$tmp/out' | grep '^  demo '"
done
for words in "help morph" "morph -h" "morph --help"; do
    runs "$words" 0 $words
    check "$words" grep '^Usage: harmorph morph MESH BASIS' "$tmp/out"
done
refuses "help of no command" 2 "'moph' is unknown; did you mean 'morph'?" help moph
refuses "a command with wrong letters" 2 "'slove' is unknown; did you mean 'solve'?" slove
refuses "a command like no other" 2 "'frobnicate' is unknown" frobnicate
check "a command like no other: no proposal" sh -c "! grep 'did you mean' '$tmp/err'"
refuses "an option with wrong letters" 2 "'--markre' is unknown; did you mean '--marker'?" fit "$ring" \
    --markre body -o "$tmp/x"
refuses "a marker with wrong letters" 2 "did you mean 'body'?" fit "$ring" --marker Boddy -o "$tmp/x"
refuses "no condition" 2 '--curve MARKER=FILE' solve "$ring" -o "$tmp/x"
refuses "an unknown movement" 2 'turn, shift, scale, flap, rigid or mode' morph "$ring" "$basis" \
    --by 'trun body 3' -o "$tmp/x"
refuses "a line of moves is no file" 2 "harmorph: --by '1 2': the option needs index dx dy here" \
    morph "$ring" "$basis" --by '1 2' -o "$tmp/x"
runs "morph without -o" 0 morph "$ring" "$basis" --move "$no_moves"
check "morph without -o: nothing is written" grep '^morphed mesh  *not written: -o FILE' "$tmp/out"
runs "morph with -o" 0 morph "$ring" "$basis" --move "$no_moves" -o "$tmp/said.su2"
check "morph with -o: the file" grep "^morphed mesh  *$tmp/said.su2" "$tmp/out"
