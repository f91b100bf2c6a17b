# Sourced by the test scripts, which say before what they are about and where the output of a check goes:
#     topic=MPI log=$dir/log
#     . tests/count.sh
# Then each of these counts one check and, where it fails, says so with the topic:
#     check WHAT COMMAND...     the command succeeds; otherwise its output is shown
#     passes WHAT STATUS [LOG]  an exit status that is 0; otherwise the file LOG is shown
#     is_empty WHAT TEXT        nothing offends; otherwise the offenders are shown
#     ok, fail WHAT [LOG]       what the script judged itself
# and `skip WHAT REASON` says aloud what is not checked. `finish [FOLDER]` prints the last line, "N passed, M failed";
# its status is the script's; the folder of the outputs goes if all passed. What is shown is indented, so that no count
# in it is added up.
passed=0 failed=0 skipped=0
ok() { passed=$((passed + 1)); }
fail() {
    failed=$((failed + 1))
    echo "FAIL $topic: $1"
    if [ -n "${2:-}" ]; then tail -n 40 "$2" | sed 's/^/    /'; fi
}
check() {
    checked=$1; shift
    if "$@" >"$log" 2>&1; then ok; else fail "$checked" "$log"; fi
}
passes() { if [ "$2" = 0 ]; then ok; else fail "$1" "${3:-}"; fi; }
is_empty() { if [ -z "$2" ]; then ok; else fail "$1: $(echo $2)"; fi; }
skip() { skipped=$((skipped + 1)); echo "skipped: $1, as $2"; }
finish() {
    if [ $skipped -gt 0 ]; then echo "$skipped skipped"; fi
    echo "$passed passed, $failed failed"
    [ $failed = 0 ] || return 1
    if [ -n "${1:-}" ]; then rm -rf "$1"; fi
}
