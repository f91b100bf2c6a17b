# Sourced by run.sh. Every field of the structs of options in the C headers can be set from the program: a line `sets`
# names the field, a command, and options with which the output of the command is another one; a line `fixed` names a
# field that the program does not set, and the reason. A new field without a line fails. After that: the choice of the
# engine.

fields=$tmp/fields
: >"$fields"
# What a command leaves: its output without times, its messages, and the files that begin with "traced".
trace() { # trace FILE COMMAND [OPTION...]
    to=$1; shift
    rm -f "$tmp"/traced*
    "$@" >"$tmp/out" 2>"$tmp/err"
    code=$?
    sed 's/"[a-z_]*_seconds": [^,}]*//g' "$tmp/out" >"$to"
    cat "$tmp/err" >>"$to"
    for file in "$tmp"/traced*; do if [ -f "$file" ]; then cat "$file" >>"$to"; fi; done
    return $code
}
sets() { # sets FIELD COMMAND OPTION...
    field=$1 with=$2; shift 2
    echo "$field" >>"$fields"
    trace "$tmp/before" "$with"
    passes "$field: $with" $? "$tmp/before"
    trace "$tmp/again" "$with"
    check "$field: $with: the same twice" cmp "$tmp/before" "$tmp/again"
    trace "$tmp/after" "$with" "$@"
    code=$? # 2 and 3: the options are not understood
    if [ $code -le 1 ] && ! cmp -s "$tmp/before" "$tmp/after"; then ok; else
        fail "$field: $* change nothing ($with, exit code $code)" "$tmp/err"
    fi
    "$harmorph" "${with%%_*}" --help >"$tmp/help"
    for word; do case $word in --*) check "$field: help has $word" grep -e "^ *$word" "$tmp/help" ;; esac; done
}
fixed() { # fixed FIELD REASON
    echo "$1" >>"$fields"
    check "$1: a reason" [ ${#2} -gt 20 ]
}

fit_ring() { "$harmorph" fit "$ring" --marker body -o "$tmp/traced" --json "$@"; }
fit_tied() { fit_ring --closed tied "$@"; }
solve_ring() { "$harmorph" solve "$ring" --curve body="$curve" -o "$tmp/traced" --json "$@"; }
solve_laplace() { solve_ring --operator laplace "$@"; }
solve_free() { solve_laplace --free far "$@"; }
echo '577 576 2 .5' >"$tmp/fluxes.txt"
solve_multigrid() { solve_laplace --engine multigrid "$@"; }
solve_fas() { solve_laplace --engine fas "$@"; }
solve_body() { "$harmorph" solve "$box" --rigid block -o "$tmp/traced" --json "$@"; }
morph_far() { "$harmorph" morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe -o "$tmp/traced" \
    --json "$@"; }
morph_near() { "$harmorph" morph "$box" "$tmp/conformal.basis" --move "$tmp/turn3.txt" --safe -o "$tmp/traced" \
    --json "$@"; }
morph_laplace() { "$harmorph" morph "$box" "$tmp/laplace.basis" --move "$tmp/turn60.txt" --safe -o "$tmp/traced" \
    --json "$@"; }
morph_better() { "$harmorph" morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" --improve -o "$tmp/traced" \
    --json "$@"; }
awk 'BEGIN { for (k = 0; k < 48; ++k) print k, (k % 3) / 2 }' >"$tmp/weights.txt"
line_curve() { printf 'degree 1\nclosed open\npoints 2\n%s\n%s\nknots 4\n0 0 1 1\n' "$1" "$2"; }
line_curve "12 0" "12 12" >"$tmp/right.curve"
line_curve "0 0" "12 0" >"$tmp/low.curve"

fixed hm_executor.run "the program has threads of its own; --threads says how many"
fixed hm_executor.user "belongs to hm_executor.run"
sets hm_executor.n_threads solve_ring --threads 2
echo hm_executor.kernel >>"$fields"
kernels=0
for kernel in baseline avx2 avx512 neon; do
    if solve_ring --kernel $kernel >"$tmp/out" 2>"$tmp/err"; then
        kernels=$((kernels + 1))
    else
        check "--kernel $kernel: refused, as the processor lacks it" says "does not have these instructions"
    fi
done
check "--kernel baseline: every processor has it" [ $kernels -gt 0 ]
if [ $kernels -gt 1 ]; then sets hm_executor.kernel solve_ring --kernel baseline; fi

sets hm_fit_options.degree fit_ring --degree 2
sets hm_fit_options.n_control fit_ring --points 9
sets hm_fit_options.closed fit_ring --closed open
fixed hm_fit_options.index_base "messages name points as the mesh file counts them"
for field in options.details details.weights details.n_weights; do
    sets hm_fit_$field fit_ring --weights "$tmp/weights.txt"
done
sets hm_fit_details.smoothing fit_ring --smooth 1
sets hm_fit_details.tolerance fit_ring --tolerance 1e-2
for field in begin_x begin_y; do sets hm_fit_details.$field fit_tied --begin .1,-1; done
for field in end_x end_y; do sets hm_fit_details.$field fit_tied --end .1,-1; done

for field in marker kind body; do sets hm_condition.$field solve_body --rigid out; done
for field in x y; do sets hm_condition.$field solve_body --rigid out=3,4; done
for field in first_curve n_curves; do sets hm_condition.$field solve_body --curve out="$tmp/right.curve"; done
sets hm_condition.partner solve_body --periodic low:high
for field in piece near_x near_y; do sets hm_condition.$field solve_body --slip low@6:0; done
for field in n_fluxes flux_points fluxes; do
    sets hm_problem.$field solve_free --flux "$tmp/fluxes.txt"
done
sets hm_condition.along solve_body --slip low="$tmp/low.curve"

sets hm_options.operator_kind solve_ring --operator laplace
sets hm_options.engine solve_laplace --engine multigrid
sets hm_options.offset_correction solve_ring --offset-correction
sets hm_options.tolerance solve_multigrid --tol 1e-3
fixed hm_options.progress "the program draws a bar where its output is a terminal"
fixed hm_options.progress_user "belongs to hm_options.progress"
sets hm_options.executor solve_ring --threads 2
sets hm_options.exponent solve_ring --exponent 1
sets hm_options.study solve_laplace --scheme bounded

sets hm_study_options.scheme solve_laplace --scheme bounded
sets hm_study_options.levels solve_multigrid --levels 2
sets hm_study_options.agglomeration solve_fas --agglomeration isotropic
sets hm_study_options.block_width solve_multigrid --block-width 16
sets hm_study_options.max_iterations solve_multigrid --max-iterations 3
sets hm_study_options.cycle solve_fas --cycle improved
for field in history history_length; do
    sets hm_study_options.$field solve_multigrid --history "$tmp/traced.csv"
done
sets hm_study_options.start solve_fas --start zero

sets hm_safe_options.max_resolves morph_far --max-resolves 0
sets hm_safe_options.skipped_strategies morph_far --skip substeps
for field in n_others others; do sets hm_safe_options.$field morph_laplace --other "$tmp/conformal.basis"; done
sets hm_safe_options.improve morph_near --improve
sets hm_safe_options.heights morph_far --heights-part .5
sets hm_safe_options.reached morph_far --reached "$tmp/traced.reached"
sets hm_safe_options.min_quality morph_far --min-quality .99
sets hm_safe_options.max_height_change morph_far --max-height-change 1.01
fixed hm_safe_options.derivative "the program does not compute derivatives of safe movements"

sets hm_improve_options.max_solutions morph_better --improve-work 1
sets hm_safe_options.improve_work morph_far --improve-work 1
fixed hm_improve_options.reference "the cells of MESH are the targets; other coordinates would be another mesh file"

include=$here/../../../include
awk -f "$here/../../../c_api/packaging/table.awk" $(sed "s|^|$include/|" "$here/../../../fortran/harmorph/headers") |
    awk '$1 == "member" && ($2 ~ /_options$|_details$|^hm_executor$|^hm_condition$/ || $3 ~ /flux/) \
        && $3 !~ /^(struct_size|reserved)$/ {
        print $2 "." $3 }' | sort >"$tmp/declared"
check "fields are declared" [ -s "$tmp/declared" ]
check "every field of the options has a line here" sh -c 'sort -u "$0" | diff "$1" -' "$fields" "$tmp/declared"

# --paper stands for the options of the paper that are not given: the line that it prints makes the same file.
solve_paper() { "$harmorph" solve "$ring" --curve body="$curve" "$@" -o "$tmp/paper.basis"; }
settings() { awk '/^Options of the paper:/ { paper = 1; next } /^[A-Z]/ { paper = 0 } paper' "$tmp/help"; }
"$harmorph" solve --help >"$tmp/help"
settings >"$tmp/settings"
for option in --paper --scheme --agglomeration --start --cycle; do
    check "the options of the paper are one group: $option" grep -q "^  $option\b" "$tmp/settings"
done
for given in "" "--scheme compact" "--start=zero --tol 1e-8" "--cycle improved --agglomeration directional"; do
    runs "--paper $given" 0 solve "$ring" --curve body="$curve" --paper $given -o "$tmp/paper.basis"
    sed -n 's/^harmorph solve //p' "$tmp/out" >"$tmp/line"
    check "--paper $given: the line names operator and engine" \
        grep -q -e '--operator laplace.* --engine fas' "$tmp/line"
    check "--paper $given: the line has no --paper" sh -c '! grep -q -e --paper "$1"' sh "$tmp/line"
    for word in $(echo "$given" | tr = ' '); do
        check "--paper $given: the line keeps $word once" test "$(grep -o -e " $word " "$tmp/line" | wc -l)" = 1
    done
    mv "$tmp/paper.basis" "$tmp/by_paper.basis"
    check "--paper $given: the line runs" eval "\"\$harmorph\" solve $(cat "$tmp/line") >\"\$tmp/out\" 2>&1"
    check "--paper $given: the line prints no line" sh -c '! grep -q "^harmorph solve" "$1"' sh "$tmp/out"
    check "--paper $given: the same basis as by the line" cmp "$tmp/paper.basis" "$tmp/by_paper.basis"
done
solve_paper --paper --start zero >"$tmp/out" && cp "$tmp/paper.basis" "$tmp/zero.basis"
solve_paper --operator laplace --engine fas --scheme nodal-gradient --agglomeration isotropic >"$tmp/out"
check "--paper: a start from zero is another iteration" \
    sh -c '! cmp -s "$1" "$2"' sh "$tmp/paper.basis" "$tmp/zero.basis"
runs "--paper --json" 0 solve "$ring" --curve body="$curve" --paper --json -o "$tmp/paper.basis"
check "--paper --json: one object on standard output" test "$(wc -l <"$tmp/out")" -eq 1
check "--paper --json: the line is a message" grep -q '^harmorph: the same as: harmorph solve' "$tmp/err"
refuses "--paper by another engine" 2 '--agglomeration needs --engine fas' solve "$ring" --curve body="$curve" --paper \
    --engine direct -o "$tmp/x"

# The choice of the engine: the first one whose bytes fit. The bytes are those that a limit of 16 MB is refused with.
make_ring 256 80 >"$tmp/many.su2"
solve_many() { "$harmorph" solve "$tmp/many.su2" --curve body="$curve" -o "$tmp/many.basis" --json "$@"; }
needs() { sed -n "s/.*$1 needs \([0-9.]*\) MB.*/\1/p; s/.*[,:] $1 \([0-9.]*\) MB.*/\1/p" "$tmp/err" | head -n 1; }
engine() { sed -n 's/.*"engine": "\([^:]*\):.*/\1/p' "$tmp/out"; }
for options in "--operator laplace" "--operator conformal" "--operator conformal --slip far"; do
    solve_many $options --memory 16 >"$tmp/out" 2>"$tmp/err"
    code=$?
    check "--memory 16, $options: refused" [ $code = 1 ]
    list="direct:$(needs direct)"
    case $options in
    *slip*) check "$options: not by multigrid" sh -c "! grep multigrid '$tmp/err'" ;;
    *) list="$list multigrid:$(needs multigrid)" ;;
    esac
    check "--memory 16, $options: bytes of all engines ($list)" sh -c \
        'for one; do case $one in *:[1-9]*) ;; *) exit 1 ;; esac; done' sh $list
    for limit in $(echo "$list" | tr ' ' '\n' | awk -F: '{ print $2 * .999, $2 * 1.001 }') 1e6; do
        wanted=$(echo "$list" | tr ' ' '\n' | awk -F: -v limit="$limit" '$2 <= limit { print $1; exit }')
        solve_many $options --memory "$limit" >"$tmp/out" 2>"$tmp/err"
        case $? in 0) found=$(engine) ;; 1) found= ;; *) found=error ;; esac
        check "--memory $limit, $options: '$found' of $list" [ "$found" = "$wanted" ]
    done
done
runs "--engine auto: enough memory" 0 solve "$ring" --curve body="$curve" -o "$tmp/automatic.basis" --json
check "--engine auto: the reason" grep -E '"engine": "direct: the fastest engine, and its [0-9.]+ MB fit' "$tmp/out"
runs "--engine direct" 0 solve "$ring" --curve body="$curve" --engine direct -o "$tmp/direct.basis"
check "--engine auto: the bits of the direct engine" cmp "$tmp/automatic.basis" "$tmp/direct.basis"
runs "--engine fas is never chosen for another one" 1 solve "$ring" --curve body="$curve" --operator laplace \
    --engine fas --memory .01 -o "$tmp/x"
refuses "--memory 0" 2 '--memory expects a number above 0' solve "$ring" --curve body="$curve" --memory 0 -o "$tmp/x"
# Without --memory the limit is what the system has left, of which `ulimit` takes a part. (Sanitizers need more.)
if (ulimit -v 2000000 && "$harmorph" --version) >/dev/null 2>&1 && [ -r /proc/self/statm ]; then
    found= kilobytes=150000
    while [ $kilobytes -gt 20000 ] && [ -z "$found" ]; do
        (ulimit -v $kilobytes && solve_many --operator conformal >"$tmp/out" 2>"$tmp/err")
        found=$(engine | grep multigrid)
        kilobytes=$((kilobytes * 97 / 100))
    done
    check "less and less memory: multigrid" [ -n "$found" ]
    check "less and less memory: the reason" says 'MB that the system has left; direct needs'
else
    skip "less and less memory" "the program does not run in an address space of 2000000 KiB"
fi
